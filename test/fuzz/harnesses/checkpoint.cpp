#include <nlohmann/json.hpp>
#include <stdexcept>

#include "fuzz/harness.hpp"
#include "fuzz/scratch_file.hpp"
#include "training/training_checkpoint.hpp"

namespace lstm_planner::fuzz::checkpoint_harness {
namespace {

void readCheckpoint(const std::uint8_t* data, std::size_t size) {
  static ScratchFile file;
  static const nlohmann::json settings = {{"method", "imitation"}, {"cells", {8, 8}}};
  file.write(data, size);
  expectRefusal<std::invalid_argument>([size] {
    const auto checkpoint = readTrainingCheckpoint(file.path(), settings);
    require(checkpoint && checkpoint->settings == settings, "another training's checkpoint is refused");
    require(checkpoint->learner.size() < size, "the learner is in the file");
  });
}

const Registration registration("checkpoint", &readCheckpoint);

}  // namespace
}  // namespace lstm_planner::fuzz::checkpoint_harness
