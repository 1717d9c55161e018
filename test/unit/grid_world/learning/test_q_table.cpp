#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "lstm_planner/grid/map_generators.hpp"
#include "lstm_planner/grid_world/evaluation/grid_episode.hpp"
#include "lstm_planner/grid_world/learning/q_table.hpp"
#include "lstm_planner/grid_world/search/grid_distances.hpp"

namespace lstm_planner::test_q_table {
namespace {

PassableGrid smallMaze() {
  MazeParameters parameters;
  parameters.columns = parameters.rows = 16;
  parameters.corridor_width = 2;
  return generateMaze(parameters, 3);
}

std::vector<CellIndex> freeCells(const PassableGrid& grid) {
  std::vector<CellIndex> cells;
  for (const CellIndex cell : grid.cells()) {
    if (grid.passable(cell)) cells.push_back(cell);
  }
  return cells;
}

/// Three cells in a row, by hand with alpha = 1/4 and gamma = 1/2.
TEST(QTable, AValueMovesTowardsTheRewardAndTheBestValueOfTheNextCell) {
  const PassableGrid grid(3, 1, true);
  QTableParameters parameters;
  parameters.learning_rate = 0.25;
  parameters.discount = 0.5;
  parameters.exploration = 0.0;
  parameters.max_steps = 1;
  QTable table(parameters, grid, {2, 0});
  Random random(1);
  table.runEpisode({0, 0}, random);
  EXPECT_EQ(table.value({0, 0}), -0.25);
  table.runEpisode({1, 0}, random);  // each of its two moves is tried: what was tried is worth less than nothing
  table.runEpisode({1, 0}, random);
  EXPECT_EQ(table.value({1, 0}), -0.25);  // of the move to the goal
  table.runEpisode({0, 0}, random);
  EXPECT_EQ(table.value({0, 0}), -0.25 + 0.25 * (-1.0 + 0.5 * -0.25 + 0.25));
  EXPECT_EQ(table.value({2, 0}), 0.0);
  EXPECT_EQ(table.steps(), 4);
}

TEST(QTable, ValuesBecomeTheLengthsOfTheShortestPathsAndTheAgentWalksThem) {
  const PassableGrid grid = smallMaze();
  const std::vector<CellIndex> cells = freeCells(grid);
  const CellIndex goal = cells.back();
  QTableParameters parameters;
  parameters.learning_rate = 1.0;  // nothing is random here
  QTable table(parameters, grid, goal);
  Random random(1);
  for (int episode = 0; episode < 3000; ++episode) table.runEpisode(cells[uniformIndex(random, cells.size())], random);
  const GridDistances distances(grid, goal, CornerCutting::kForbidden);
  const RangeTable ranges(grid);
  for (const CellIndex& cell : cells) {
    // Sums of float.
    EXPECT_NEAR(-table.value(cell), static_cast<double>(distances.at(cell)), 1e-3);
    QTableAgent agent(table);
    const GridEpisode episode = runGridEpisode(grid, ranges, cell, goal, {}, &agent);
    EXPECT_EQ(episode.end, GridEpisode::End::kArrived);
    EXPECT_LE(episode.length(), static_cast<double>(distances.at(cell)) + 1e-3);
  }
}

TEST(QTable, KnowsOnlyPossibleMoves) {
  PassableGrid grid(3, 3, true);
  grid.set({1, 0}, false);
  grid.set({0, 1}, false);
  const QTable table({}, grid, {2, 2});
  EXPECT_EQ(table.bestMove({0, 0}), kNoPath);  // the diagonal passes blocked cells
  QTableParameters cutting;
  cutting.corner_cutting = CornerCutting::kAllowed;
  EXPECT_NE(QTable(cutting, grid, {2, 2}).bestMove({0, 0}), kNoPath);
}

TEST(QTable, RefusesWhatMakesNoSense) {
  PassableGrid grid(3, 3, true);
  grid.set({1, 1}, false);
  EXPECT_THROW(QTable({}, grid, {1, 1}), std::invalid_argument);
  EXPECT_THROW(QTable({}, grid, {3, 0}), std::invalid_argument);
  QTableParameters parameters;
  parameters.learning_rate = 0.0;
  EXPECT_THROW(QTable(parameters, grid, {0, 0}), std::invalid_argument);
  parameters = {};
  parameters.discount = 1.5;
  EXPECT_THROW(QTable(parameters, grid, {0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_q_table
