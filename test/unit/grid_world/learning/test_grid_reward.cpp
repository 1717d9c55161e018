#include <gtest/gtest.h>

#include <cmath>

#include "grid_world/learning/grid_reward.hpp"

namespace lstm_planner::test_grid_reward {
namespace {

TEST(ThesisReward, CountsNearWallsDistanceAndTurnAsCosts) {
  GridMemory memory;
  memory.start();
  GridObservation observation;
  observation.cell = {4, 4};
  observation.goal = {4, 7};
  observation.ranges = {1, 2, 2, 4, 4, 4, 4, 50};
  memory.observe(observation);
  const ThesisRewardWeights weights{1.0, 10.0, 100.0};
  const double proximity = 1.0 + 0.5 + 0.5 + 4 * 0.25 + 0.02;
  EXPECT_NEAR(thesisReward(memory, weights), -(proximity + 10.0 * 3.0), 1e-12);
  // It came from the west, so that the goal, along the columns, is a quarter turn away.
  memory.step(0);
  EXPECT_NEAR(thesisReward(memory, weights), -(proximity + 10.0 * 3.0 + 100.0 * M_PI / 2), 1e-9);
}

}  // namespace
}  // namespace lstm_planner::test_grid_reward
