#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lstm_planner/simulation/localiser.hpp"
#include "lstm_planner/simulation/simulated_robot.hpp"

namespace lstm_planner::test_localiser {
namespace {

TEST(Localiser, LeavesOdometryAloneUntilItIsWrongByTheJump) {
  Localiser localiser({5.0, 2.0, M_PI_2}, 0.3);
  const Pose2 odometry{1.0, 0.0, 0.0};
  localiser.localise({5.0, 3.29, M_PI_2}, odometry);  // 1.29 m ahead of the start, odometry says 1 m
  EXPECT_EQ(localiser.correct(odometry).x, 1.0);
}

TEST(Localiser, CorrectsPositionAndHeadingByOneJump) {
  Localiser localiser({5.0, 2.0, M_PI_2}, 0.3);
  const Pose2 odometry{1.0, 0.0, 0.0};
  localiser.localise({4.9, 3.31, M_PI_2 + 0.1}, odometry);
  const Pose2 corrected = localiser.correct(odometry);
  EXPECT_NEAR(corrected.x, 1.31, 1e-12);
  EXPECT_NEAR(corrected.y, 0.1, 1e-12);
  EXPECT_NEAR(corrected.yaw, 0.1, 1e-12);
}

TEST(Localiser, WithoutAJumpNothingIsCorrected) {
  Localiser localiser({}, 0.0);
  localiser.localise({7.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  EXPECT_EQ(localiser.correct({1.0, 0.0, 0.0}).x, 1.0);
}

TEST(Localiser, KeepsTheBelievedPoseOfARobotWithinTheJumpOfTheTruth) {
  const CircleWorld world({});
  SimulatedRobot::Parameters parameters;
  parameters.base.drift = 0.05;  // it drives in curves where odometry believes in a straight line
  parameters.localisation_jump = 0.3;
  const Pose2 start{3.0, -1.0, 0.7};
  SimulatedRobot robot(world, parameters, start, 1);
  robot.command({0.3, 0.0});
  double farthest = 0.0;
  for (int i = 0; i < 600; ++i) {
    robot.advance(0.1);
    farthest = std::max(farthest, distanceBetween(compose(start, robot.believedPose()), robot.truePose()));
  }
  EXPECT_LT(farthest, 0.3);
  EXPECT_GT(distanceBetween(compose(start, robot.odometry()), robot.truePose()), 3.0);
}

}  // namespace
}  // namespace lstm_planner::test_localiser
