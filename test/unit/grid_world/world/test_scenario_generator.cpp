#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lstm_planner/grid/map_generators.hpp"
#include "lstm_planner/grid_world/world/scenario_generator.hpp"

namespace lstm_planner::test_scenario_generator {
namespace {

/// Dijkstra's algorithm in its plainest form, in double precision.
double shortestPath(const PassableGrid& grid, CellIndex start, CellIndex goal) {
  std::vector<double> lengths(grid.size(), std::numeric_limits<double>::infinity());
  using Open = std::pair<double, std::size_t>;
  std::priority_queue<Open, std::vector<Open>, std::greater<Open>> open;
  lengths[grid.offset(start)] = 0.0;
  open.push({0.0, grid.offset(start)});
  while (!open.empty() && open.top().second != grid.offset(goal)) {
    const auto [length, offset] = open.top();
    open.pop();
    const int columns = grid.columns();
    const CellIndex cell{static_cast<int>(offset) % columns, static_cast<int>(offset) / columns};
    for (int direction = 0; direction < kGridMoveCount; ++direction) {
      if (!movePossible(grid, cell, direction, CornerCutting::kForbidden)) continue;
      double& known = lengths[grid.offset(cellBeside(cell, direction))];
      if (length + moveLength(direction) >= known) continue;
      known = length + moveLength(direction);
      open.push({known, grid.offset(cellBeside(cell, direction))});
    }
  }
  return lengths[grid.offset(goal)];
}

PassableGrid smallMap() { return generateRandomFill({40, 30, 0.3, true}, 1); }

TEST(ScenarioGenerator, GivesTheTrueLengthsInTheirBuckets) {
  const PassableGrid grid = smallMap();
  const std::vector<Scenario> scenarios = drawScenarios(grid, "a.map", {10}, 1);
  ASSERT_FALSE(scenarios.empty());
  for (const Scenario& scenario : scenarios) {
    checkScenario(scenario, 1, grid, "a.scen");
    EXPECT_NEAR(scenario.optimal_length, shortestPath(grid, scenario.start, scenario.goal), 1e-9);
    EXPECT_EQ(scenario.bucket, static_cast<int>(std::floor(scenario.optimal_length / 4.0)));
    EXPECT_NE(scenario.start, scenario.goal);
    EXPECT_EQ(scenario.map, "a.map");
  }
}

TEST(ScenarioGenerator, KeepsLongLengthsExactTo6Digits) {
  // A path of 4428.04 cells with many diagonal moves, for which a sum of floats gives 4428.05.
  const PassableGrid grid = generateMaze({201, 201, 2, 0.0}, 1);
  const std::vector<Scenario> scenarios = drawScenarios(grid, "a.map", {1}, 1);
  const Scenario& longest = scenarios.back();
  ASSERT_GT(longest.optimal_length, 4000.0);
  EXPECT_NEAR(longest.optimal_length, shortestPath(grid, longest.start, longest.goal), 1e-9);
}

TEST(ScenarioGenerator, FillsBucketsInTheirOrder) {
  const std::vector<Scenario> scenarios = drawScenarios(PassableGrid(100, 100, true), "a.map", {7}, 1);
  std::vector<int> count(static_cast<std::size_t>(scenarios.back().bucket) + 1);
  for (const Scenario& scenario : scenarios) ++count[static_cast<std::size_t>(scenario.bucket)];
  EXPECT_TRUE(std::is_sorted(scenarios.begin(), scenarios.end(),
                             [](const Scenario& a, const Scenario& b) { return a.bucket < b.bucket; }));
  EXPECT_EQ(*std::max_element(count.begin(), count.end()), 7);
  // The farthest cell is always at least 50 columns or rows away: the buckets below 48 cells are filled by any goal.
  for (std::size_t bucket = 0; bucket < 12; ++bucket) EXPECT_EQ(count[bucket], 7);
}

TEST(ScenarioGenerator, GivesTheSameForTheSameSeedOnly) {
  const auto starts = [](std::uint64_t seed) {
    std::vector<std::pair<int, int>> cells;
    for (const Scenario& scenario : drawScenarios(smallMap(), "a.map", {3}, seed)) {
      cells.emplace_back(scenario.start.column, scenario.start.row);
    }
    return cells;
  };
  EXPECT_EQ(starts(1), starts(1));
  EXPECT_NE(starts(1), starts(2));
}

TEST(ScenarioGenerator, GivesNoneWhereNoTwoCellsAreConnected) {
  EXPECT_TRUE(drawScenarios(PassableGrid(5, 5, false), "a.map", {10}, 1).empty());
  PassableGrid grid(5, 5, false);
  grid.set({0, 0}, true);
  EXPECT_TRUE(drawScenarios(grid, "a.map", {10}, 1).empty());
  grid.set({4, 4}, true);
  EXPECT_TRUE(drawScenarios(grid, "a.map", {10}, 1).empty());
}

TEST(ScenarioGenerator, TellsHowFarItIs) {
  std::vector<double> shares;
  drawScenarios(smallMap(), "a.map", {5}, 1, [&](double share) { shares.push_back(share); });
  ASSERT_GE(shares.size(), 5u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_LE(shares.back(), 1.0);
}

TEST(ScenarioGenerator, RefusesBucketsWithoutScenarios) {
  EXPECT_THROW(drawScenarios(smallMap(), "a.map", {0}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_scenario_generator
