#include <cmath>
#include <stdexcept>

#include "fuzz/harness.hpp"
#include "fuzz/scratch_file.hpp"
#include "lstm_planner/common/csv_file.hpp"

namespace lstm_planner::fuzz::csv_harness {
namespace {

void readCsv(const std::uint8_t* data, std::size_t size) {
  static ScratchFile file;
  file.write(data, size);
  expectRefusal<std::invalid_argument>([] {
    const CsvFile csv(file.path(), {"x", "y"}, {"yaw"});
    for (std::size_t line = 0; line < csv.lines(); ++line) {
      require(std::isfinite(csv.number(line, 0)) && std::isfinite(csv.number(line, 1)), "numbers are finite");
      require(csv.has(2) == std::isfinite(csv.number(line, 2)), "an optional column is there as a whole or not at all");
    }
  });
}

const Registration registration("csv", &readCsv);

}  // namespace
}  // namespace lstm_planner::fuzz::csv_harness
