#include "lstm_planner/robot/dataset/dataset_export.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "lstm_planner/base/common/output_file.hpp"
#include "robot/dataset/dataset_columns.hpp"
#include "robot/dataset/step_quantities.hpp"

namespace lstm_planner {

namespace {

void writeNames(std::ostream& out, std::size_t beams) {
  out << "recording,episode,number";
  DriveStep step;
  visitColumns(step, [&](const std::string& name, const char*, auto&) { out << ',' << name; });
  for (std::size_t beam = 0; beam < beams; ++beam) out << ",beam_" << beam;
  out << '\n';
}

template <typename Number>
void writeNumber(std::ostream& out, Number number) {
  out << ',';
  if (std::isfinite(static_cast<double>(number))) out << number;
}

void writeRows(const Dataset& dataset, bool with_scans, std::ostream& out) {
  const std::size_t beams = with_scans ? mostBeams(dataset) : 0;
  writeNames(out, beams);
  forEachStep(dataset, [&](long recording, long episode, const DriveStep& step) {
    out << recording << ',' << episode << ',' << step.number;
    out.precision(std::numeric_limits<double>::max_digits10);
    visitColumns(step, [&](const std::string&, const char*, const auto& number) { writeNumber(out, number); });
    out.precision(std::numeric_limits<float>::max_digits10);
    for (std::size_t beam = 0; beam < beams; ++beam) {
      writeNumber(out, beam < step.ranges.size() ? step.ranges[beam] : std::numeric_limits<float>::quiet_NaN());
    }
    out << '\n';
  });
}

}  // namespace

void exportCsv(const std::string& path, const Dataset& dataset, bool with_scans) {
  try {
    OutputFile file(path);
    writeRows(dataset, with_scans, file.stream());
    file.commit();
  } catch (const OutputFileError& error) {
    throw DatasetError("'" + path + "' cannot be written: " + error.what());
  }
}

}  // namespace lstm_planner
