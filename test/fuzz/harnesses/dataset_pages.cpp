#include <string>

#include "fuzz/fuzz_dataset.hpp"
#include "fuzz/fuzz_input.hpp"
#include "fuzz/scratch_file.hpp"

namespace lstm_planner::fuzz::dataset_pages_harness {
namespace {

/// A sound dataset of which some bytes are others, or whose end is missing.
void readDamaged(const std::uint8_t* data, std::size_t size) {
  static ScratchFile file(".sqlite");
  static const std::string sound = soundDataset();
  FuzzInput input(data, size);
  const int reader = input.byte();
  std::string bytes = sound;
  if (input.byte() % 16 == 1)
    bytes.resize(static_cast<std::size_t>(input.integer(0, static_cast<std::int64_t>(bytes.size()))));
  while (!input.empty() && !bytes.empty()) {
    auto at = static_cast<std::size_t>(input.raw<std::uint16_t>()) % bytes.size();
    // The first 100 bytes are the file's header, and each page's first say how it is cut up.
    const std::uint8_t kind = input.byte();
    if (kind % 4 == 0) at %= 100;
    if (kind % 4 == 1) at = at / 4096 * 4096 + at % 16;
    for (int count = kind / 64; count >= 0 && at < bytes.size(); --count) bytes[at++] = static_cast<char>(input.byte());
  }
  file.write(bytes);
  readDatasetFile(file.path(), reader);
}

const Registration registration("dataset_pages", &readDamaged);

}  // namespace
}  // namespace lstm_planner::fuzz::dataset_pages_harness
