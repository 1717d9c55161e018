#include <algorithm>
#include <filesystem>

#include "support/real_data.hpp"
#include "unit/grid_world/world/movingai_fixtures.hpp"

namespace lstm_planner::test_movingai_real_data {
namespace {

TEST(MovingAiRealData, EveryScenarioFitsItsMap) {
  const std::string folder = realData("movingai");
  SKIP_WITHOUT_REAL_DATA(folder);
  std::size_t scenario_count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".scen") continue;
    const std::string path = entry.path().string();
    const std::vector<Scenario> scenarios = readScenarios(path);
    const PassableGrid grid = readMovingAiMap(mapOfScenarioFile(path));
    for (std::size_t i = 0; i < scenarios.size(); ++i) {
      ASSERT_NO_THROW(checkScenario(scenarios[i], i + kFirstScenarioLine, grid, path));
    }
    scenario_count += scenarios.size();
  }
  EXPECT_GT(scenario_count, 0u);
}

}  // namespace
}  // namespace lstm_planner::test_movingai_real_data
