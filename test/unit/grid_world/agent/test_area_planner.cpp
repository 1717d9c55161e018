#include <gtest/gtest.h>

#include "lstm_planner/grid_world/agent/area_planner.hpp"
#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner::test_area_planner {
namespace {

TEST(AreaPlanner, SearchesTheBlocksAnewOnlyWhereThePathHasBecomeWorse) {
  constexpr std::size_t kBlocksToTheGoal = 100;
  PassableGrid grid(500, 101, true);
  const CellIndex goal = {420, 50};
  AreaPlanner planner;
  planner.restart({20, 50}, {20, 50});
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

}  // namespace
}  // namespace lstm_planner::test_area_planner
