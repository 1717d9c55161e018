#include <gtest/gtest.h>

#include <vector>

#include "lstm_planner/grid_world/agent/area_planner.hpp"
#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner::test_area_planner {
namespace {

TEST(AreaPlanner, SearchesTheBlocksAnewOnlyWhereThePathHasBecomeWorse) {
  constexpr std::size_t kBlocksToTheGoal = 100;
  PassableGrid grid(500, 101, true);
  const CellIndex goal = {420, 50};
  AreaPlanner planner;
  planner.restart({20, 50});
  planner.searchBlocks();
  const auto look = [&](CellIndex cell) {
    planner.observe({cell, goal, senseRanges(grid, cell)});
    return planner.plan();
  };
  ASSERT_EQ(look({20, 50}), 0) << "to the east";
  const std::size_t first = planner.expandedCells();
  EXPECT_GE(first, kBlocksToTheGoal);

  // One cell on the path turns out to be blocked: its block can still be passed.
  grid.set({40, 50}, false);
  EXPECT_NE(look({21, 50}), kNoPath);
  const std::size_t second = planner.expandedCells() - first;
  EXPECT_GT(second, 0u) << "cells";
  EXPECT_LT(second, kBlocksToTheGoal);

  // A wall from edge to edge, of which the agent sees more and more, closes passages on the path.
  for (int i = 0; i <= 100; ++i) grid.set({22, i}, false);
  look({21, 50});
  for (int row = 1; row < 100; ++row) look({21, row});
  EXPECT_GE(planner.expandedCells() - first - second, kBlocksToTheGoal);
}

/// Walks along the path; the number of steps, or -1.
int walk(AreaPlanner* planner, const PassableGrid& grid, CellIndex cell, CellIndex goal, int max_steps) {
  planner->restart(cell);
  for (int step = 0; step <= max_steps; ++step) {
    if (cell == goal) return step;
    planner->observe({cell, goal, senseRanges(grid, cell)});
    const int direction = planner->plan();
    if (direction == kNoPath || !movePossible(grid, cell, direction, CornerCutting::kForbidden)) return -1;
    cell = cellBeside(cell, direction);
  }
  return -1;
}

TEST(AreaPlanner, GoesStraightWhereNothingIsInTheWay) {
  AreaPlanner planner;
  EXPECT_EQ(walk(&planner, PassableGrid(500, 500, true), {20, 20}, {420, 300}, 1000), 400);
  EXPECT_FALSE(planner.searchesBlocks());
}

TEST(AreaPlanner, SearchesBlocksFromWhenThePathIsLong) {
  // A cup that opens away from the goal.
  PassableGrid grid(200, 60, true);
  for (int row = 5; row <= 45; ++row) grid.set({100, row}, false);
  for (int column = 50; column < 100; ++column) {
    grid.set({column, 5}, false);
    grid.set({column, 45}, false);
  }
  AreaPlanner planner;
  EXPECT_GT(walk(&planner, grid, {95, 25}, {110, 25}, 1000), 2 * 45);
  EXPECT_TRUE(planner.searchesBlocks());
}

/// An open hall with the agent in its middle, which has planned its path to the east.
AreaPlanner plannerInHall(bool searches_blocks) {
  const PassableGrid hall(100, 100, true);
  AreaPlanner planner;
  planner.restart({50, 50});
  if (searches_blocks) planner.searchBlocks();
  const CellIndex goal{80, 50};
  planner.observe({{50, 50}, goal, senseRanges(hall, {50, 50})});
  EXPECT_EQ(planner.plan(), 0);
  return planner;
}

TEST(AreaPlanner, KnowsWhatEachMoveCosts) {
  // 30 cells to the east; a diagonal move counts 1.4.
  const std::vector<double> regrets = {0.0, 0.8, 1.4, 2.8, 2.0, 2.8, 1.4, 0.8};
  for (const bool searches_blocks : {false, true}) {
    AreaPlanner planner = plannerInHall(searches_blocks);
    for (int direction = 0; direction < kGridMoveCount; ++direction) {
      EXPECT_NEAR(planner.regretOf(direction), regrets[static_cast<std::size_t>(direction)], 1e-9) << direction;
    }
  }
}

TEST(AreaPlanner, KeepsThePathFromWhereAnotherMoveHasLed) {
  const PassableGrid hall(100, 100, true);
  AreaPlanner planner = plannerInHall(false);
  planner.regretOf(1);
  const std::size_t expanded = planner.expandedCells();
  planner.observe({{51, 51}, {80, 50}, senseRanges(hall, {51, 51})});
  EXPECT_NE(planner.plan(), kNoPath);
  EXPECT_EQ(planner.expandedCells(), expanded) << "nothing to search for again";
  planner.observe({{20, 20}, {80, 50}, senseRanges(hall, {20, 20})});
  EXPECT_NE(planner.plan(), kNoPath);
  EXPECT_GT(planner.expandedCells(), expanded) << "somebody has carried the agent away";
}

}  // namespace
}  // namespace lstm_planner::test_area_planner
