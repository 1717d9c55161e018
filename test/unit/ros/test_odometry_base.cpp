#include <gtest/gtest.h>
#include <tf2/buffer_core.h>

#include <cmath>

#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/common/odometry_base.hpp"

namespace lstm_planner::test_odometry_base {
namespace {

class OdometryBaseTest : public ::testing::Test {
 protected:
  void placeCamera(const Pose2& pose) { tf_.setTransform(toMessage(pose, "base_footprint", "camera"), "test", true); }

  tf2::BufferCore tf_;
  OdometryBase base_{tf_, "base_footprint"};
};

/// A camera ahead of the wheels moves sideways while the robot turns on the spot; one that looks back goes backwards.
TEST_F(OdometryBaseTest, TurnsWhatACameraDoesIntoWhatTheWheelsDo) {
  placeCamera({0.3, 0.1, 0.0});
  EXPECT_TRUE(base_.setFrame("camera"));
  const Pose2 ahead = base_.poseOf({0.3, 0.1, 0.0});
  EXPECT_NEAR(std::hypot(ahead.x, ahead.y), 0.0, 1e-12);
  const Pose2 turned = base_.poseOf({-0.1, 0.3, M_PI_2});
  EXPECT_NEAR(std::hypot(turned.x, turned.y), 0.0, 1e-12);
  EXPECT_NEAR(base_.twistOf({-0.1 * 2.0, 2.0}, 0.3 * 2.0).linear, 0.0, 1e-12);
  EXPECT_EQ(base_.twistOf({0.5, 0.0}, 0.0).linear, 0.5);

  placeCamera({-0.2, 0.0, M_PI});
  EXPECT_TRUE(base_.setFrame("camera"));
  EXPECT_NEAR(base_.twistOf({-0.5, 1.0}, 0.2).linear, 0.5, 1e-12);
  EXPECT_NEAR(base_.poseOf({-0.2, 0.0, M_PI}).yaw, 0.0, 1e-12);
}

TEST_F(OdometryBaseTest, ANameThatTfDoesNotKnowIsOfTheBaseUntilItDoes) {
  EXPECT_FALSE(base_.setFrame("camera"));
  EXPECT_FALSE(base_.isKnown());
  EXPECT_EQ(base_.poseOf({1.0, 0.0, 0.0}).x, 1.0);
  placeCamera({0.3, 0.0, 0.0});
  EXPECT_TRUE(base_.setFrame("camera"));
  EXPECT_TRUE(base_.isKnown());
  EXPECT_FALSE(base_.setFrame("camera")) << "where it was";
  tf_.clear();
  EXPECT_FALSE(base_.setFrame("camera"));
  EXPECT_NEAR(base_.poseOf({1.0, 0.0, 0.0}).x, 0.7, 1e-12) << "where it was last";
  EXPECT_TRUE(base_.setFrame("base_footprint"));
  EXPECT_EQ(base_.poseOf({1.0, 0.0, 0.0}).x, 1.0);
}

/// As base_link by an IMU: its origin is above base_footprint, and moves over it.
TEST_F(OdometryBaseTest, ABodyThatTiltsOverItsWheelsHasNotMovedOnThem) {
  placeCamera({0.3, 0.0, 0.0});
  EXPECT_TRUE(base_.setFrame("camera"));
  for (const double aside : {0.005, -0.02, 0.0}) {
    placeCamera({0.3 + aside, 0.0, 0.1 * aside});
    EXPECT_FALSE(base_.setFrame("camera"));
    EXPECT_NEAR(base_.poseOf({0.3 + aside, 0.0, 0.1 * aside}).x, 0.0, 1e-12);
  }
  placeCamera({0.45, 0.0, 0.0});
  EXPECT_TRUE(base_.setFrame("camera")) << "it was placed anew";
}

TEST_F(OdometryBaseTest, SaysSoIfTheFrameIsTilted) {
  geometry_msgs::TransformStamped down = toMessage(Pose2{0.3, 0.0, 0.0}, "base_footprint", "camera");
  down.transform.rotation.y = std::sin(0.2);
  down.transform.rotation.w = std::cos(0.2);
  tf_.setTransform(down, "test", true);
  EXPECT_FALSE(base_.setFrame("camera"));
  EXPECT_EQ(base_.problem(), "camera is tilted by more than 15 degrees against base_footprint");
  placeCamera({0.3, 0.0, 0.0});
  EXPECT_TRUE(base_.setFrame("camera"));
  EXPECT_EQ(base_.problem(), "");
}

}  // namespace
}  // namespace lstm_planner::test_odometry_base
