#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lstm_planner/base/common/random.hpp"
#include "lstm_planner/grid_world/agent/rolling_planner.hpp"
#include "lstm_planner/grid_world/search/grid_distances.hpp"
#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner::test_rolling_planner {
namespace {

PassableGrid randomGrid(int side, double share, std::uint64_t seed) {
  PassableGrid grid(side, side, true);
  Random random(seed);
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) grid.set({column, row}, uniform(random) >= share);
  }
  return grid;
}

GridObservation observationAt(const PassableGrid& grid, CellIndex cell, CellIndex goal) {
  return {cell, goal, senseRanges(grid, cell)};
}

TEST(RollingGrid, RemembersWhereRaysEndedAndNothingElse) {
  const PassableGrid grid = randomGrid(60, 0.2, 1);
  RollingGrid walls;
  walls.observe(observationAt(grid, {30, 30}, {0, 0}));
  const GridRanges ranges = senseRanges(grid, {30, 30});
  int marked = 0;
  for (int row = -20; row < 80; ++row) {
    for (int column = -20; column < 80; ++column) marked += walls.isWall({column, row}) ? 1 : 0;
  }
  EXPECT_EQ(marked, kGridRayCount);
  EXPECT_TRUE(walls.isWall({30 + ranges[0], 30}));
  EXPECT_TRUE(walls.isWall({30 - ranges[5], 30 - ranges[5]}));
}

TEST(RollingGrid, DoesNotTakeTheEndOfTheSensorForAWall) {
  RollingGrid walls;
  EXPECT_FALSE(walls.observe(observationAt(PassableGrid(400, 400, true), {200, 200}, {0, 0})));
}

TEST(RollingGrid, RollsWithTheAgentAndForgetsWhatLeavesTheWindow) {
  const PassableGrid grid = randomGrid(600, 0.2, 2);
  RollingGrid walls;
  Random random(3);
  CellIndex cell{300, 300};
  for (int step = 0; step < 5000; ++step) {
    walls.observe({cell, {0, 0}, senseRanges(grid, cell)});
    // What is remembered is true, here and at the window's edges.
    for (int i = 0; i < 20; ++i) {
      const CellIndex asked{cell.column - 100 + static_cast<int>(uniformIndex(random, 200)),
                            cell.row - 100 + static_cast<int>(uniformIndex(random, 200))};
      ASSERT_FALSE(walls.isWall(asked) && grid.passable(asked));
    }
    const CellIndex next = cellBeside(cell, static_cast<int>(uniformIndex(random, 8)));
    if (grid.contains({next.column * 2 - 300, next.row * 2 - 300})) cell = next;
  }
  const CellIndex end{cell.column + senseRanges(grid, cell)[0], cell.row};
  EXPECT_TRUE(walls.isWall(end));
  walls.observe({{cell.column + 5000, cell.row}, {0, 0}, {50, 50, 50, 50, 50, 50, 50, 50}});
  walls.observe({cell, {0, 0}, {50, 50, 50, 50, 50, 50, 50, 50}});
  EXPECT_FALSE(walls.isWall(end));
}

/// Walks where `decide` says; the number of steps, or -1.
template <typename Decide>
int walk(const Decide& decide, const PassableGrid& grid, CellIndex cell, CellIndex goal, int max_steps) {
  for (int step = 0; step <= max_steps; ++step) {
    if (cell == goal) return step;
    const int direction = decide(observationAt(grid, cell, goal));
    if (direction == kNoPath || !movePossible(grid, cell, direction, CornerCutting::kForbidden)) return -1;
    cell = cellBeside(cell, direction);
  }
  return -1;
}

/// The same with a planner.
int walk(RollingPlanner* planner, const PassableGrid& grid, CellIndex cell, CellIndex goal, int max_steps) {
  planner->start();
  const auto decide = [&](const GridObservation& observation) {
    planner->observe(observation);
    return planner->direction();
  };
  return walk(decide, grid, cell, goal, max_steps);
}

TEST(RollingPlanner, GoesStraightWhereNothingIsInTheWay) {
  RollingPlanner planner;
  EXPECT_EQ(walk(&planner, PassableGrid(500, 500, true), {20, 20}, {420, 300}, 1000), 400);
}

TEST(RollingPlanner, ArrivesWhereverThereIsAPathInAMapThatFitsTheWindow) {
  // The window is 160 cells and the agent within 16 cells of its middle: nothing of 60 cells is ever forgotten, and
  // what is known of the walls only grows. A random walk shows that the limit of steps tells good from bad.
  constexpr double kMostSteps = 4.0;  // a cell of the shortest path
  RollingPlanner planner;
  Random random(4);
  int reachable = 0;
  int reached_by_chance = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    PassableGrid grid = randomGrid(60, 0.1 + 0.002 * static_cast<double>(seed), seed);
    grid.set({3, 3}, true);
    grid.set({55, 50}, true);
    const float length = GridDistances(grid, {55, 50}, CornerCutting::kForbidden).at({3, 3});
    if (std::isinf(length)) {
      EXPECT_EQ(walk(&planner, grid, {3, 3}, {55, 50}, 60 * 60 * 60), -1) << seed;
      continue;
    }
    const int max_steps = static_cast<int>(kMostSteps * length);
    ++reachable;
    EXPECT_GE(walk(&planner, grid, {3, 3}, {55, 50}, max_steps), 52) << seed;
    const auto wander = [&](const GridObservation& observation) {
      int direction = 0;
      do {
        direction = static_cast<int>(uniformIndex(random, 8));
      } while (!movePossible(grid, observation.cell, direction, CornerCutting::kForbidden));
      return direction;
    };
    reached_by_chance += walk(wander, grid, {3, 3}, {55, 50}, max_steps) > 0 ? 1 : 0;
  }
  EXPECT_GT(reachable, 100);
  EXPECT_LT(reached_by_chance, reachable / 10);
}

TEST(RollingPlanner, TheFirstPlanInAKnownPlaceIsAsShortAsTheShortestPath) {
  // All walls within sight: one beside each ray would do, so the place is a plus of corridors one cell wide.
  PassableGrid grid(30, 30, false);
  for (int i = 5; i < 25; ++i) {
    grid.set({15, i}, true);
    grid.set({i, 15}, true);
  }
  RollingPlanner planner;
  planner.start();
  planner.observe(observationAt(grid, {15, 15}, {15, 24}));
  EXPECT_EQ(planner.direction(), 2);
  EXPECT_NEAR(planner.length(), 9.0, 1e-9);
}

TEST(RollingPlanner, PlansAgainWhenSomebodyElseMadeTheStep) {
  const PassableGrid grid(200, 200, true);
  RollingPlanner planner;
  planner.start();
  planner.observe(observationAt(grid, {50, 50}, {100, 50}));
  EXPECT_EQ(planner.direction(), 0);
  planner.observe(observationAt(grid, {50, 60}, {50, 90}));
  EXPECT_EQ(planner.direction(), 2);
}

TEST(RollingPlanner, NeedsLessThan26KiB) { EXPECT_LT(RollingPlanner().bytes(), 26u * 1024u); }

}  // namespace
}  // namespace lstm_planner::test_rolling_planner
