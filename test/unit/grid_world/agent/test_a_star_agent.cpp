#include <gtest/gtest.h>

#include <stdexcept>

#include "grid_world/agent/a_star_agent.hpp"
#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner::test_a_star_agent {
namespace {

/// A wall across the middle with a gap at the far end.
PassableGrid gridWithWall() {
  PassableGrid grid(20, 11, true);
  for (int row = 0; row < 10; ++row) grid.set({10, row}, false);
  return grid;
}

TEST(AStarAgent, WalksAShortestPath) {
  const PassableGrid grid = gridWithWall();
  const CellIndex goal{18, 2};
  CellIndex cell{2, 2};
  const AStarResult planned = AStar(grid).find(cell, goal);
  AStarAgent agent(grid);
  agent.start(cell, goal);
  std::int64_t straight_moves = 0;
  std::int64_t diagonal_moves = 0;
  for (int step = 0; step < 100 && cell != goal; ++step) {
    agent.observe({cell, goal, senseRanges(grid, cell)});
    const int direction = agent.decide();
    ASSERT_NE(direction, kNoPath);
    EXPECT_EQ(agent.decide(), direction);
    ASSERT_TRUE(movePossible(grid, cell, direction, CornerCutting::kForbidden));
    ++(direction % 2 == 0 ? straight_moves : diagonal_moves);
    cell = cellBeside(cell, direction);
    agent.step(direction, true);
  }
  EXPECT_TRUE(cell == goal);
  EXPECT_EQ(straight_moves, planned.path.straight_moves);
  EXPECT_EQ(diagonal_moves, planned.path.diagonal_moves);
  EXPECT_EQ(agent.expandedCells(), planned.expanded);
  EXPECT_EQ(agent.peakBytes(), planned.peak_bytes + grid.size());
}

TEST(AStarAgent, FindsThatThereIsNoPath) {
  PassableGrid grid = gridWithWall();
  grid.set({10, 10}, false);
  AStarAgent agent(grid);
  agent.start({2, 2}, {18, 2});
  agent.observe({{2, 2}, {18, 2}, senseRanges(grid, {2, 2})});
  EXPECT_EQ(agent.decide(), kNoPath);
}

TEST(AStarAgent, PlansAgainWhenItIsNotWhereItWent) {
  const PassableGrid grid = gridWithWall();
  AStarAgent agent(grid);
  agent.start({2, 2}, {5, 2});
  const std::size_t planned_once = agent.expandedCells();
  agent.observe({{5, 5}, {5, 2}, senseRanges(grid, {5, 5})});
  EXPECT_EQ(agent.decide(), rayBetween({5, 5}, {5, 4}));
  EXPECT_GT(agent.expandedCells(), planned_once);
}

TEST(AStarAgent, StaysWhereItIsAfterAMoveThatFailed) {
  const PassableGrid grid = gridWithWall();
  AStarAgent agent(grid);
  agent.start({2, 2}, {5, 2});
  for (int attempt = 0; attempt < 2; ++attempt) {
    agent.observe({{2, 2}, {5, 2}, senseRanges(grid, {2, 2})});
    EXPECT_EQ(agent.decide(), 0);
    agent.step(0, false);
  }
}

TEST(AStarAgent, ForgetsTheEpisodeBefore) {
  const PassableGrid grid = gridWithWall();
  AStarAgent agent(grid);
  agent.start({2, 2}, {18, 2});
  const std::size_t expanded = agent.expandedCells();
  agent.start({2, 2}, {18, 2});
  EXPECT_EQ(agent.expandedCells(), expanded);
}

TEST(AStarAgent, RefusesAGoalInAWall) {
  const PassableGrid grid = gridWithWall();
  AStarAgent agent(grid);
  EXPECT_THROW(agent.start({2, 2}, {10, 2}), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_a_star_agent
