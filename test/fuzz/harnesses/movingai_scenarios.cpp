#include <cmath>

#include "fuzz/harness.hpp"
#include "fuzz/scratch_file.hpp"
#include "lstm_planner/grid_world/world/movingai.hpp"

namespace lstm_planner::fuzz::movingai_scenarios_harness {
namespace {

bool isInside(const CellIndex& cell, const Scenario& scenario) {
  return cell.column >= 0 && cell.column < scenario.columns && cell.row >= 0 && cell.row < scenario.rows;
}

void readScenarioFile(const std::uint8_t* data, std::size_t size) {
  static ScratchFile file(".scen");
  file.write(data, size);
  expectRefusal<MovingAiFileError>([] {
    static const PassableGrid grid(8, 4, true);
    std::size_t line = kFirstScenarioLine;
    for (const Scenario& scenario : readScenarios(file.path())) {
      require(isInside(scenario.start, scenario) && isInside(scenario.goal, scenario), "start and goal are on the map");
      require(std::isfinite(scenario.optimal_length) && scenario.optimal_length >= 0.0, "lengths are finite");
      expectRefusal<MovingAiFileError>([&] { checkScenario(scenario, line++, grid, file.path()); });
    }
  });
}

const Registration registration("movingai_scenarios", &readScenarioFile);

}  // namespace
}  // namespace lstm_planner::fuzz::movingai_scenarios_harness
