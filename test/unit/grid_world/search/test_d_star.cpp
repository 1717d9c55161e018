#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "grid_world/search/a_star.hpp"
#include "grid_world/search/d_star.hpp"
#include "unit/common/random_grid.hpp"

namespace lstm_planner::test_d_star {
namespace {

constexpr CornerCutting kBothRules[] = {CornerCutting::kForbidden, CornerCutting::kAllowed};

void tellAll(const PassableGrid& grid, DStar& search) {
  for (const CellIndex cell : grid.cells()) search.setPassable(cell, grid.passable(cell));
}

/// Along the first moves from cell to cell.
GridPath pathOf(const DStar& search, CellIndex robot) {
  std::vector<CellIndex> cells = {robot};
  while (search.firstMove(cells.back()) >= 0) {
    cells.push_back(cellBeside(cells.back(), search.firstMove(cells.back())));
  }
  return pathAlong(std::move(cells));
}

void expectSameAsAStar(const PassableGrid& grid, DStar& search, CellIndex robot, CellIndex goal,
                       CornerCutting corner_cutting) {
  const GridPath shortest = AStar(grid, {Heuristic::kOctile, corner_cutting}).find(robot, goal).path;
  ASSERT_EQ(search.plan(robot), shortest.found());
  if (!shortest.found()) return;
  const GridPath path = pathOf(search, robot);
  EXPECT_EQ(path.straight_moves, shortest.straight_moves);
  EXPECT_EQ(path.diagonal_moves, shortest.diagonal_moves);
  EXPECT_TRUE(path.cells.back() == goal);
  for (std::size_t i = 1; i < path.cells.size(); ++i) {
    EXPECT_TRUE(movePossible(grid, path.cells[i - 1], rayBetween(path.cells[i - 1], path.cells[i]), corner_cutting));
  }
}

TEST(DStar, FindsTheSameLengthAsAStarOnKnownMaps) {
  std::mt19937 random(1);
  const CellIndex robot{1, 1};
  const CellIndex goal{37, 28};
  for (int round = 0; round < 60; ++round) {
    const PassableGrid grid = randomGrid(40, 30, static_cast<unsigned>(20 + random() % 20), random, {robot, goal});
    for (const CornerCutting corner_cutting : kBothRules) {
      DStar search(40, 30, goal, corner_cutting);
      tellAll(grid, search);
      expectSameAsAStar(grid, search, robot, goal, corner_cutting);
    }
  }
}

TEST(DStar, StaysEqualToAStarWhileCellsAreBlockedAndFreed) {
  std::mt19937 random(2);
  const CellIndex goal{22, 17};
  for (const CornerCutting corner_cutting : kBothRules) {
    CellIndex robot{1, 1};
    PassableGrid grid = randomGrid(25, 20, 30, random, {robot, goal});
    DStar search(25, 20, goal, corner_cutting);
    tellAll(grid, search);
    for (int change = 0; change < 1500; ++change) {
      const CellIndex cell{static_cast<int>(random() % 25), static_cast<int>(random() % 20)};
      if (cell == robot || cell == goal) continue;
      const bool passable = random() % 3 != 0;
      grid.set(cell, passable);
      search.setPassable(cell, passable);
      if (random() % 3 == 0) continue;  // several changes before the next plan
      expectSameAsAStar(grid, search, robot, goal, corner_cutting);
      if (search.plan(robot)) robot = cellBeside(robot, search.firstMove(robot));
      if (robot == goal) robot = {1, 1};
      grid.set(robot, true);
      search.setPassable(robot, true);
    }
  }
}

TEST(DStar, RepairsLocallyWhatAChangeNearTheRobotTouches) {
  const CellIndex robot{10, 100};
  const CellIndex goal{190, 100};
  DStar search(200, 200, goal);
  ASSERT_TRUE(search.plan(robot));
  const std::size_t first_plan = search.processedStates();
  EXPECT_GT(first_plan, 10000u);  // it floods the map from the goal: 180 cells of path
  for (int row = 99; row <= 101; ++row) search.setPassable({13, row}, false);
  ASSERT_TRUE(search.plan(robot));
  // The cells behind the small wall, and as many more rows at the edge of the flood as the path has become longer.
  EXPECT_LT(search.processedStates() - first_plan, first_plan / 50);
  EXPECT_GT(pathOf(search, robot).length(), 180.0);
}

TEST(DStar, ProcessesNothingWhenNothingChangedOrWhatChangedIsFarFromThePath) {
  const CellIndex robot{10, 50};
  DStar search(100, 100, {90, 50});
  ASSERT_TRUE(search.plan(robot));
  const std::size_t first_plan = search.processedStates();
  ASSERT_TRUE(search.plan(cellBeside(robot, search.firstMove(robot))));
  search.setPassable({2, 2}, false);  // farther from the goal than the robot
  ASSERT_TRUE(search.plan(robot));
  EXPECT_EQ(search.processedStates(), first_plan);
}

TEST(DStar, FindsThatAnEnclosedRobotHasNoPathAndThatAnOpenedDoorMakesOne) {
  DStar search(20, 20, {15, 15});
  const CellIndex robot{3, 3};
  ASSERT_TRUE(search.plan(robot));
  for (int i = 1; i <= 5; ++i) {
    for (const CellIndex cell : {CellIndex{i, 1}, {i, 5}, {1, i}, {5, i}}) search.setPassable(cell, false);
  }
  EXPECT_FALSE(search.plan(robot));
  EXPECT_FALSE(search.plan(robot));
  EXPECT_EQ(search.firstMove(robot), -1);
  search.setPassable({1, 3}, true);
  ASSERT_TRUE(search.plan(robot));
  EXPECT_TRUE(pathOf(search, robot).cells[2] == (CellIndex{1, 3}));
}

TEST(DStar, TakesMemoryForThePartOfTheMapThatItTouched) {
  DStar near(4096, 4096, {2000, 2000});
  ASSERT_TRUE(near.plan({2010, 2000}));
  DStar far(4096, 4096, {2000, 2000});
  ASSERT_TRUE(far.plan({2100, 2000}));
  const std::size_t directory = 256 * 256 * sizeof(void*);
  EXPECT_LT(near.peakBytes() - directory, 100u * 1024u);
  EXPECT_GT(far.peakBytes() - directory, 10u * (near.peakBytes() - directory));
}

TEST(DStar, RefusesAGoalOutside) { EXPECT_THROW(DStar(5, 5, {5, 0}), std::invalid_argument); }

}  // namespace
}  // namespace lstm_planner::test_d_star
