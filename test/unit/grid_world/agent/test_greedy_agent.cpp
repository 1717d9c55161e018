#include <gtest/gtest.h>

#include "lstm_planner/grid_world/agent/greedy_agent.hpp"
#include "unit/grid_world/agent/small_grids.hpp"
#include "unit/grid_world/sense_ranges.hpp"

namespace lstm_planner::test_greedy_agent {
namespace {

TEST(GreedyAgent, TakesTheShortestPathInTheOpen) {
  const SmallGrid world = drawnGrid({"S......", ".......", "......G"});
  GreedyAgent agent;
  const Walk walked = walk(world, &agent, CornerCutting::kForbidden, 100);
  EXPECT_EQ(walked.end, WalkEnd::kArrived);
  EXPECT_EQ(walked.steps, 6U);
}

TEST(GreedyAgent, WalksToAndFroInAPocket) {
  const SmallGrid world = drawnGrid({"####...", "S..#..G", "####..."});
  GreedyAgent agent;
  EXPECT_EQ(walk(world, &agent, CornerCutting::kForbidden, 1000).end, WalkEnd::kTooLong);
}

TEST(GreedyAgent, TakesTheFirstOfEquallyNearMoves) {
  const SmallGrid world = drawnGrid({"...", "S#G", "..."});
  GreedyAgent agent;
  agent.start(world.start, world.goal);
  agent.observe({world.start, world.goal, senseRanges(world.grid, world.start)});
  // North (2) and south (6): the diagonals would cut corners.
  EXPECT_EQ(agent.decide(), 2);
}

TEST(GreedyAgent, CutsCornersWhereThatIsAllowed) {
  const SmallGrid world = drawnGrid({"...", "S#G", "..."});
  GreedyAgent agent(CornerCutting::kAllowed);
  const Walk walked = walk(world, &agent, CornerCutting::kAllowed, 100);
  EXPECT_EQ(walked.end, WalkEnd::kArrived);
  EXPECT_EQ(walked.steps, 2U);
}

TEST(GreedyAgent, SaysThatItIsShutIn) {
  const SmallGrid world = drawnGrid({"S#", "#G"});
  GreedyAgent agent;
  EXPECT_EQ(walk(world, &agent, CornerCutting::kForbidden, 100).end, WalkEnd::kNoPath);
}

TEST(GreedyAgent, NeverCollides) {
  for (const CornerCutting corner_cutting : {CornerCutting::kForbidden, CornerCutting::kAllowed}) {
    GreedyAgent agent(corner_cutting);
    for (std::uint32_t seed = 0; seed < 1000; ++seed) {
      ASSERT_NE(walk(smallGrid(seed), &agent, corner_cutting, 200).end, WalkEnd::kCollided) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace lstm_planner::test_greedy_agent
