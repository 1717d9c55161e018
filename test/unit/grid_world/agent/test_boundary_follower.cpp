#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "lstm_planner/grid_world/agent/boundary_follower.hpp"
#include "lstm_planner/grid_world/search/grid_distances.hpp"
#include "unit/grid_world/agent/small_grids.hpp"
#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner::test_boundary_follower {
namespace {

struct Legs {
  double first_leg;
  double leg_growth;
  double goal_weight;
};

class BoundaryFollowerIn : public testing::TestWithParam<std::tuple<CornerCutting, Legs>> {
 protected:
  BoundaryParameters parameters() const {
    BoundaryParameters parameters;
    parameters.corner_cutting = std::get<0>(GetParam());
    parameters.first_leg = std::get<1>(GetParam()).first_leg;
    parameters.leg_growth = std::get<1>(GetParam()).leg_growth;
    parameters.goal_weight = std::get<1>(GetParam()).goal_weight;
    return parameters;
  }
};

TEST_P(BoundaryFollowerIn, SmallGridsArrivesOrProvesThatThereIsNoPath) {
  BoundaryFollower agent(parameters());
  int arrived = 0;
  int enclosed = 0;
  for (std::uint32_t seed = 0; seed < 5000; ++seed) {
    const SmallGrid world = smallGrid(seed);
    const GridDistances distances(world.grid, world.goal, parameters().corner_cutting);
    const bool reachable = std::isfinite(distances.at(world.start));
    // The grids have at most 400 cells, and so at most 1,600 edges.
    const Walk walked = walk(world, &agent, parameters().corner_cutting, 20 * world.grid.size());
    ASSERT_EQ(walked.end, reachable ? WalkEnd::kArrived : WalkEnd::kNoPath) << "seed " << seed;
    ++(reachable ? arrived : enclosed);
  }
  EXPECT_GT(arrived, 2500);
  EXPECT_GT(enclosed, 250);
}

std::string nameOfCase(const testing::TestParamInfo<BoundaryFollowerIn::ParamType>& info) {
  const char* const legs[] = {"OneCell", "Growing", "Endless"};
  const bool cuts = std::get<0>(info.param) == CornerCutting::kAllowed;
  return std::string(legs[info.index % 3]) + (cuts ? "CuttingCorners" : "KeepingCorners");
}

// Legs of one cell turn back as often as can be; legs without end never do.
INSTANTIATE_TEST_SUITE_P(Legs, BoundaryFollowerIn,
                         testing::Combine(testing::Values(CornerCutting::kForbidden, CornerCutting::kAllowed),
                                          testing::Values(Legs{1.0, 0.0, 0.0}, Legs{4.0, 1.0, 3.0},
                                                          Legs{1e9, 1.0, 0.0})),
                         nameOfCase);

TEST(BoundaryFollower, GoesStraightWhereNothingIsInTheWay) {
  const SmallGrid world = drawnGrid({"S........", ".........", ".........", "........G"});
  BoundaryFollower agent;
  const Walk walked = walk(world, &agent, CornerCutting::kForbidden, 100);
  EXPECT_EQ(walked.end, WalkEnd::kArrived);
  EXPECT_EQ(walked.steps, 8U);
}

TEST(BoundaryFollower, LeavesAPocketWithoutComingBack) {
  const SmallGrid world = drawnGrid({
      "..........",
      ".#######..",
      ".......#..",
      "S......#.G",
      ".......#..",
      ".#######..",
      "..........",
  });
  BoundaryParameters parameters;
  parameters.first_leg = 64.0;
  BoundaryFollower agent(parameters);
  const Walk walked = walk(world, &agent, CornerCutting::kForbidden, 100);
  EXPECT_EQ(walked.end, WalkEnd::kArrived);
  // 6 in, 6 back along the wall, 2 up and 9 to the goal's column, 3 down, and the wall's bends.
  EXPECT_LE(walked.steps, 28U);
}

TEST(BoundaryFollower, SaysThatAnEnclosedGoalHasNoPath) {
  const SmallGrid world = drawnGrid({"......", ".###..", ".#G#.S", ".###..", "......"});
  BoundaryFollower agent;
  EXPECT_EQ(walk(world, &agent, CornerCutting::kForbidden, 100).end, WalkEnd::kNoPath);
}

TEST(BoundaryFollower, SaysThatItIsEnclosedItself) {
  const SmallGrid world = drawnGrid({"S#..", "##..", "...G"});
  BoundaryFollower agent;
  EXPECT_EQ(walk(world, &agent, CornerCutting::kForbidden, 100).end, WalkEnd::kNoPath);
}

TEST(BoundaryFollower, PassesBetweenCornersOnlyWhereThatIsAllowed) {
  const SmallGrid world = drawnGrid({"S#.", "#..", "..G"});
  BoundaryFollower agent;
  EXPECT_EQ(walk(world, &agent, CornerCutting::kForbidden, 100).end, WalkEnd::kNoPath);
  BoundaryParameters parameters;
  parameters.corner_cutting = CornerCutting::kAllowed;
  BoundaryFollower cutting(parameters);
  const Walk walked = walk(world, &cutting, CornerCutting::kAllowed, 100);
  EXPECT_EQ(walked.end, WalkEnd::kArrived);
  EXPECT_EQ(walked.steps, 2U);
}

TEST(BoundaryFollower, AnswersTheSameWhenAskedTwice) {
  const SmallGrid world = drawnGrid({"S.#.", "..#G", "...."});
  BoundaryFollower agent;
  agent.start(world.start, world.goal);
  const GridObservation observation = {world.start, world.goal, senseRanges(world.grid, world.start)};
  agent.observe(observation);
  const int direction = agent.decide();
  EXPECT_EQ(agent.decide(), direction);
  agent.observe(observation);
  EXPECT_EQ(agent.decide(), direction);
}

TEST(BoundaryFollower, StaysSmallInALongMaze) {
  // A comb of 400 dead ends, each of which bends the path back.
  PassableGrid grid(801, 40, true);
  for (int column = 1; column < 800; column += 2) {
    for (int row = 0; row < 38; ++row) grid.set({column, row}, false);
  }
  grid.set({799, 38}, false);
  grid.set({799, 39}, false);
  const SmallGrid world = {grid, {0, 0}, {800, 0}};
  BoundaryFollower agent;
  EXPECT_EQ(walk(world, &agent, CornerCutting::kForbidden, 200000).end, WalkEnd::kNoPath);
  EXPECT_LE(agent.peakBytes(), 6U * 1024U);
}

TEST(BoundaryFollower, ArrivesWhenTheTrailHasNoRoomForThePathBack) {
  BoundaryParameters parameters;
  parameters.first_leg = 4000.0;  // 1,300 bends
  parameters.goal_weight = 0.0;
  BoundaryFollower agent(parameters);
  const Walk walked = walk(pathOfBends(), &agent, CornerCutting::kForbidden, 1000000);
  EXPECT_EQ(walked.end, WalkEnd::kArrived);
  EXPECT_LE(agent.peakBytes(), 6U * 1024U);
}

}  // namespace
}  // namespace lstm_planner::test_boundary_follower
