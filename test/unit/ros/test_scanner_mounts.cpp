#include <gtest/gtest.h>
#include <ros/time.h>
#include <tf2/buffer_core.h>

#include <cmath>
#include <string>

#include "lstm_planner/drive/perception/message_age.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "lstm_planner/ros/common/scanner_mounts.hpp"

namespace lstm_planner::test_scanner_mounts {
namespace {

class ScannerMountsTest : public ::testing::Test {
 protected:
  ScannerMountsTest() { ros::Time::init(); }  // of the computer's clock, for warnings

  void publish(const std::string& frame, const std::string& child, const Pose2& pose) {
    tf_.setTransform(toMessage(pose, frame, child), "test", true);
  }

  tf2::BufferCore tf_;
  ScannerMounts mounts_{tf_, "base_footprint"};
};

TEST_F(ScannerMountsTest, ACorrectedTransformCountsFromThenOn) {
  publish("base_footprint", "laser", {0.1, 0.0, 0.0});
  EXPECT_EQ(mounts_.at("laser").pose.yaw, 0.0);
  publish("base_footprint", "laser", {0.1, 0.0, M_PI_2});
  EXPECT_NEAR(mounts_.at("laser").pose.yaw, M_PI_2, 1e-9);
}

TEST_F(ScannerMountsTest, TheLastOneCountsWhileTfKnowsNone) {
  publish("base_footprint", "laser", {0.1, 0.0, 0.0});
  mounts_.at("laser");
  tf_.clear();
  EXPECT_EQ(mounts_.at("laser").pose.x, 0.1);
  EXPECT_THROW(mounts_.at("another"), SensorError);
}

TEST_F(ScannerMountsTest, ARobotFrameThatTfDoesNotKnowIsReplacedByTheCostmaps) {
  publish("base_footprint", "laser", {0.1, 0.0, 0.0});
  mounts_.setBaseFrame("base_link");  // by child_frame_id of the odometry
  EXPECT_EQ(mounts_.at("laser").pose.x, 0.1);
  publish("base_footprint", "base_link", {0.3, 0.0, 0.0});
  EXPECT_NEAR(mounts_.at("laser").pose.x, -0.2, 1e-9) << "as soon as tf knows it";
}

}  // namespace
}  // namespace lstm_planner::test_scanner_mounts
