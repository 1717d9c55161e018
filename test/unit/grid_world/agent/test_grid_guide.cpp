#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/grid/map_generators.hpp"
#include "lstm_planner/grid_world/agent/boundary_follower.hpp"
#include "lstm_planner/grid_world/agent/grid_guide.hpp"
#include "lstm_planner/grid_world/search/grid_distances.hpp"
#include "unit/grid_world/agent/small_grids.hpp"

namespace lstm_planner::test_grid_guide {
namespace {

class GridGuideWith : public testing::TestWithParam<CornerCutting> {};

TEST_P(GridGuideWith, ArrivesOrProvesThatThereIsNoPathAndNeverCollides) {
  GridGuideParameters parameters;
  parameters.corner_cutting = GetParam();
  int unreachable = 0;
  for (std::uint32_t seed = 0; seed < 1000; ++seed) {
    const SmallGrid world = smallGrid(seed);
    const bool reachable = std::isfinite(GridDistances(world.grid, world.goal, GetParam()).at(world.start));
    unreachable += reachable ? 0 : 1;
    GridGuide agent(parameters);
    // Boundary following arrives in 20 steps a cell, and is asked after a few hundred steps.
    const std::size_t most_steps = 10000 + 400 * world.grid.size();
    ASSERT_EQ(walk(world, &agent, GetParam(), most_steps).end, reachable ? WalkEnd::kArrived : WalkEnd::kNoPath)
        << "seed " << seed;
  }
  EXPECT_GT(unreachable, 50);
}

INSTANTIATE_TEST_SUITE_P(Corners, GridGuideWith, testing::Values(CornerCutting::kForbidden, CornerCutting::kAllowed),
                         [](const auto& info) {
                           return std::string(info.param == CornerCutting::kAllowed ? "Cut" : "Kept");
                         });

/// A dead end 300 cells deep that the goal lies behind: the way is back and around, and the mouth is forgotten by a
/// window of 160 cells.
SmallGrid longDeadEnd() {
  SmallGrid world;
  world.grid = PassableGrid(420, 140, true);
  for (int column = 60; column <= 360; ++column) {
    world.grid.set({column, 50}, false);
    world.grid.set({column, 80}, false);
  }
  for (int row = 50; row <= 80; ++row) world.grid.set({360, row}, false);
  world.start = {350, 65};
  world.goal = {380, 65};
  return world;
}

TEST(GridGuide, LeavesADeadEndLongerThanTheWindowOfCells) {
  const SmallGrid world = longDeadEnd();
  const double optimum = GridDistances(world.grid, world.goal, CornerCutting::kForbidden).at(world.start);
  GridGuide agent;
  const Walk walked = walk(world, &agent, CornerCutting::kForbidden, 100000);
  ASSERT_EQ(walked.end, WalkEnd::kArrived);
  // There is one way out, so little can be lost: boundaries are not followed.
  EXPECT_LT(static_cast<double>(walked.steps), 1.2 * optimum);
}

TEST(GridGuide, WalksFarLessThanBoundaryFollowingInMazesThatTheWindowOfCellsForgets) {
  std::size_t guided = 0;
  std::size_t along_boundaries = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    MazeParameters maze;
    maze.columns = 400;
    maze.rows = 400;
    maze.corridor_width = 8;
    SmallGrid world;
    world.grid = generateMaze(maze, seed);
    world.start = {4, 4};
    world.goal = {393, 393};
    GridGuide agent;
    const Walk walked = walk(world, &agent, CornerCutting::kForbidden, 1000000);
    ASSERT_EQ(walked.end, WalkEnd::kArrived) << "seed " << seed;
    guided += walked.steps;
    BoundaryFollower boundary;
    along_boundaries += walk(world, &boundary, CornerCutting::kForbidden, 1000000).steps;
  }
  // On the grid benchmark's mazes a third.
  EXPECT_LT(guided, along_boundaries * 6 / 10);
}

TEST(GridGuide, NeedsAtMost56KiB) {
  // So that a network of the thesis's size fits beside it into 64 KiB.
  GridGuide agent;
  const SmallGrid world = longDeadEnd();
  ASSERT_EQ(walk(world, &agent, CornerCutting::kForbidden, 100000).end, WalkEnd::kArrived);
  EXPECT_LE(agent.peakBytes(), 56u * 1024u);
}

TEST(GridGuide, RefusesParametersThatMakeNoSense) {
  GridGuideParameters parameters;
  parameters.most_steps_more = -1;
  EXPECT_THROW(GridGuide{parameters}, std::invalid_argument);
  parameters = {};
  parameters.area.most_detour = -1.0;
  EXPECT_THROW(GridGuide{parameters}, std::invalid_argument);
  parameters = {};
  parameters.area.doubtful_cost = 1000.0;
  EXPECT_THROW(GridGuide{parameters}, std::invalid_argument);
  parameters = {};
  parameters.last_resort.patience = 0;
  EXPECT_THROW(GridGuide{parameters}, std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_grid_guide
