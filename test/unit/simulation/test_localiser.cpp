#include <gtest/gtest.h>

#include <cmath>

#include "lstm_planner/simulation/localiser.hpp"

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

}  // namespace
}  // namespace lstm_planner::test_localiser
