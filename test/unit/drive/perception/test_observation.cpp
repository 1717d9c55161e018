#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lstm_planner/drive/perception/observation.hpp"

namespace lstm_planner::test_observation {
namespace {

TEST(Observe, GivesDistanceAndSignedBearingInTheRobotFrame) {
  // Facing north, the goal in the west is 90 degrees to the left, the goal in the east 90 degrees to the right.
  const Pose2 pose{1.0, 1.0, M_PI_2};
  EXPECT_NEAR(observe({}, pose, {-2.0, 1.0}, 0.0).goal_bearing, M_PI_2, 1e-12);
  const Observation right = observe({}, pose, {5.0, 1.0}, 0.25);
  EXPECT_NEAR(right.goal_bearing, -M_PI_2, 1e-12);
  EXPECT_NEAR(right.goal_distance, 4.0, 1e-12);
  EXPECT_NEAR(right.heading, M_PI_2, 1e-12);
  EXPECT_EQ(right.previous_action, 0.25);
}

TEST(Observe, WrapsBearingAndHeading) {
  const Observation observation = observe({}, {0.0, 0.0, 3.0 * M_PI}, {1.0, 0.0}, 0.0);
  EXPECT_NEAR(std::abs(observation.goal_bearing), M_PI, 1e-12);
  EXPECT_NEAR(observation.heading, M_PI, 1e-12);
}

TEST(Observe, AsksForNoTurnOnTheGoal) { EXPECT_EQ(observe({}, {2.0, 3.0, 1.0}, {2.0, 3.0}, 0.0).goal_bearing, 0.0); }

TEST(Observe, RoundsThePositionToTheCentreOfItsCell) {
  // Cells of 0.35 m: 0.1 and 0.3 share the cell around 0.175, -0.1 lies in the one around -0.175.
  const Observation a = observe({}, {0.1, 0.3, 0.0}, {1.175, 0.175}, 0.0, 0.35);
  const Observation b = observe({}, {0.3, 0.1, 0.0}, {1.175, 0.175}, 0.0, 0.35);
  EXPECT_EQ(a.goal_distance, b.goal_distance);
  EXPECT_NEAR(a.goal_distance, 1.0, 1e-12);
  EXPECT_NEAR(observe({}, {-0.1, 0.1, 0.0}, {0.825, 0.175}, 0.0, 0.35).goal_distance, 1.0, 1e-12);
}

TEST(Observe, TakesTheStraightPathForTheRouteOfAnAgentThatRemembersNothing) {
  const Observation observation = observe({}, {1.0, 1.0, M_PI_2}, {-2.0, 1.0}, 0.0);
  EXPECT_EQ(observation.route_bearing, observation.goal_bearing);
  EXPECT_EQ(observation.route_length, observation.goal_distance);
  for (const double visits : observation.visits) EXPECT_EQ(visits, 0.0);
}

TEST(YawOfQuaternion, IsTheYawAndNotAComponent) {
  for (const double yaw : {-3.0, -1.0, 0.0, 0.5, 2.0, M_PI}) {
    EXPECT_NEAR(yawOfQuaternion(0.0, 0.0, std::sin(yaw / 2.0), std::cos(yaw / 2.0)), yaw, 1e-12);
    EXPECT_NEAR(yawOfQuaternion(0.0, 0.0, 5e-200 * std::sin(yaw / 2.0), 5e-200 * std::cos(yaw / 2.0)), yaw, 1e-12);
  }
}

TEST(YawOfQuaternion, KeepsTheYawOfATiltedBase) {
  // Yaw 1 after a roll of 0.2: q = q_yaw * q_roll.
  const double x = std::cos(0.5) * std::sin(0.1);
  const double y = std::sin(0.5) * std::sin(0.1);
  const double z = std::sin(0.5) * std::cos(0.1);
  EXPECT_NEAR(yawOfQuaternion(x, y, z, std::cos(0.5) * std::cos(0.1)), 1.0, 1e-12);
}

TEST(YawOfQuaternion, IsNanWithoutOrientation) {
  EXPECT_TRUE(std::isnan(yawOfQuaternion(0.0, 0.0, 0.0, 0.0)));
  EXPECT_TRUE(std::isnan(yawOfQuaternion(0.0, 0.0, std::numeric_limits<double>::quiet_NaN(), 1.0)));
}

}  // namespace
}  // namespace lstm_planner::test_observation
