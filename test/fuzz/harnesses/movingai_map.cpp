#include "fuzz/harness.hpp"
#include "fuzz/scratch_file.hpp"
#include "lstm_planner/grid_world/world/movingai.hpp"

namespace lstm_planner::fuzz::movingai_map_harness {
namespace {

void readMap(const std::uint8_t* data, std::size_t size) {
  static ScratchFile file(".map");
  file.write(data, size);
  expectRefusal<MovingAiFileError>([size] {
    const PassableGrid grid = readMovingAiMap(file.path());
    require(grid.columns() > 0 && grid.rows() > 0, "a map has cells");
    require(static_cast<std::size_t>(grid.columns()) * static_cast<std::size_t>(grid.rows()) < size,
            "each cell is a letter of the file");
  });
}

const Registration registration("movingai_map", &readMap);

}  // namespace
}  // namespace lstm_planner::fuzz::movingai_map_harness
