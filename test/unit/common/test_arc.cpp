#include <gtest/gtest.h>

#include "lstm_planner/common/arc.hpp"

namespace lstm_planner::test_arc {
namespace {

TEST(Arc, AQuarterOfACircleByItsTurn) {
  const double radius = 2.0;
  const Pose2 end = alongTurn({1.0, 1.0, 0.0}, radius * M_PI_2, M_PI_2);
  EXPECT_NEAR(end.x, 1.0 + radius, 1e-12);
  EXPECT_NEAR(end.y, 1.0 + radius, 1e-12);
  EXPECT_NEAR(end.yaw, M_PI_2, 1e-12);
}

TEST(Arc, TheSameByItsCurvature) {
  const Pose2 by_turn = alongTurn({0.5, -1.0, 0.3}, 1.5, -0.6);
  const Pose2 by_curvature = alongArc({0.5, -1.0, 0.3}, -0.4, 1.5);
  EXPECT_NEAR(distanceBetween(by_turn, by_curvature), 0.0, 1e-12);
  EXPECT_NEAR(by_turn.yaw, by_curvature.yaw, 1e-12);
}

TEST(Arc, WithoutATurnItIsStraight) {
  const Pose2 end = alongTurn({0.0, 0.0, M_PI_2}, -0.5, 0.0);
  EXPECT_NEAR(end.x, 0.0, 1e-12);
  EXPECT_NEAR(end.y, -0.5, 1e-12);
}

TEST(Arc, OdometryGoesStraightInTheMeanHeading) {
  const Pose2 end = alongMeanHeading({0.0, 0.0, M_PI - 0.1}, 1.0, 0.2);
  EXPECT_NEAR(end.x, -1.0, 1e-12);
  EXPECT_NEAR(end.y, 0.0, 1e-12);
  EXPECT_NEAR(end.yaw, -M_PI + 0.1, 1e-12) << "normalised";
}

}  // namespace
}  // namespace lstm_planner::test_arc
