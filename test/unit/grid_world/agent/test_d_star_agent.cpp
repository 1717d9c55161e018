#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "grid_world/agent/d_star_agent.hpp"
#include "grid_world/search/a_star.hpp"
#include "unit/common/random_grid.hpp"
#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner::test_d_star_agent {
namespace {

struct Episode {
  bool arrived = false;
  bool gave_up = false;
  bool collided = false;
  int steps = 0;
  std::size_t first_plan = 0;
};

Episode drive(const PassableGrid& grid, DStarAgent& agent, CellIndex start, CellIndex goal,
              CornerCutting corner_cutting = CornerCutting::kForbidden) {
  constexpr int kMostSteps = 5000;
  agent.start(start, goal);
  Episode episode;
  CellIndex cell = start;
  while (cell != goal && episode.steps < kMostSteps) {
    agent.observe({cell, goal, senseRanges(grid, cell)});
    const int direction = agent.decide();
    if (episode.steps++ == 0) episode.first_plan = agent.expandedCells();
    episode.gave_up = direction == kNoPath;
    if (episode.gave_up) return episode;
    episode.collided = !movePossible(grid, cell, direction, corner_cutting);
    if (episode.collided) return episode;
    EXPECT_EQ(agent.decide(), direction);
    cell = cellBeside(cell, direction);
    agent.step(direction, true);
  }
  episode.arrived = cell == goal;
  return episode;
}

TEST(DStarAgent, ArrivesWithoutCollisionExactlyIfThereIsAWay) {
  std::mt19937 random(1);
  int paths = 0;
  for (int round = 0; round < 60; ++round) {
    const CellIndex start{1, 1};
    const CellIndex goal{37, 28};
    const PassableGrid grid = randomGrid(40, 30, 35, random, {start, goal});
    for (const CornerCutting corner_cutting : {CornerCutting::kForbidden, CornerCutting::kAllowed}) {
      const bool is_path = AStar(grid, {Heuristic::kOctile, corner_cutting}).find(start, goal).path.found();
      DStarAgent agent(40, 30, corner_cutting);
      const Episode episode = drive(grid, agent, start, goal, corner_cutting);
      EXPECT_FALSE(episode.collided);
      EXPECT_EQ(episode.arrived, is_path);
      EXPECT_EQ(episode.gave_up, !is_path);
      paths += is_path ? 1 : 0;
    }
  }
  EXPECT_GT(paths, 20);  // both cases must have been met
  EXPECT_LT(paths, 100);
}

TEST(DStarAgent, GoesStraightWhereNothingIsInTheWay) {
  const PassableGrid grid(300, 20, true);
  DStarAgent agent(300, 20);
  const Episode episode = drive(grid, agent, {5, 5}, {280, 12});
  EXPECT_TRUE(episode.arrived);
  EXPECT_EQ(episode.steps, 275);
  EXPECT_EQ(agent.expandedCells(), episode.first_plan);  // nothing was new, so nothing was repaired
}

TEST(DStarAgent, LeavesADeadEndThatItSeesFromInsideOnly) {
  PassableGrid grid(60, 61, true);
  for (int row = 10; row <= 50; ++row) grid.set({40, row}, false);
  for (int column = 10; column <= 40; ++column) {
    grid.set({column, 10}, false);
    grid.set({column, 50}, false);
  }
  DStarAgent agent(60, 61);
  EXPECT_TRUE(drive(grid, agent, {20, 30}, {50, 30}).arrived);
}

TEST(DStarAgent, RepairsForLessThanPlanningAgain) {
  std::mt19937 random(2);
  const CellIndex start{2, 2};
  const CellIndex goal{147, 147};
  const PassableGrid grid = randomGrid(150, 150, 20, random, {start, goal});
  DStarAgent agent(150, 150);
  const Episode episode = drive(grid, agent, start, goal);
  ASSERT_TRUE(episode.arrived);
  const std::size_t repaired = agent.expandedCells() - episode.first_plan;
  EXPECT_LT(repaired, episode.first_plan * static_cast<std::size_t>(episode.steps) / 20);
}

TEST(DStarAgent, ForgetsTheEpisodeBefore) {
  std::mt19937 random(3);
  const PassableGrid grid = randomGrid(40, 30, 20, random, {{1, 1}, {37, 28}});
  DStarAgent agent(40, 30);
  const Episode first = drive(grid, agent, {1, 1}, {37, 28});
  const std::size_t expanded = agent.expandedCells();
  const std::size_t bytes = agent.peakBytes();
  const Episode second = drive(grid, agent, {1, 1}, {37, 28});
  EXPECT_EQ(second.steps, first.steps);
  EXPECT_EQ(agent.expandedCells(), expanded);
  EXPECT_EQ(agent.peakBytes(), bytes);
}

TEST(DStarAgent, RefusesAGoalOutside) {
  EXPECT_THROW(DStarAgent(10, 10).start({1, 1}, {0, -1}), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_d_star_agent
