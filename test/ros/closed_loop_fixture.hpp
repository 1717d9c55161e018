#pragma once

#include <actionlib/client/simple_action_client.h>
#include <gtest/gtest.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <std_msgs/UInt32.h>
#include <std_srvs/SetBool.h>

#include <cmath>
#include <mutex>
#include <string>

#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/callback_thread.hpp"
#include "ros/fake_robot.hpp"
#include "ros/log_listener.hpp"

namespace lstm_planner {

/// Sends goals to move_base, which drives create2_stub, and looks at where the robot truly is. Nothing may be touched.
class ClosedLoopTest : public testing::Test {
 protected:
  ClosedLoopTest() : client_("move_base", true) {
    ros::NodeHandle node_handle = callbacks_.nodeHandle();
    truth_ = node_handle.subscribe("create2_stub/ground_truth", 10, &ClosedLoopTest::onTruth, this);
    contacts_ = node_handle.subscribe("create2_stub/contacts", 10, &ClosedLoopTest::onContacts, this);
  }

  void SetUp() override {
    ASSERT_TRUE(client_.waitForServer(ros::Duration(60.0)));
    ASSERT_TRUE(eventually([&] { return hasTruth(); }));
  }

  void TearDown() override {
    pauseScan(false);
    client_.cancelAllGoals();
    const std::lock_guard<std::mutex> lock(mutex_);
    EXPECT_EQ(contact_count_, 0u);
  }

  void send(const std::string& frame, const Pose2& pose) {
    move_base_msgs::MoveBaseGoal goal;
    goal.target_pose.header.frame_id = frame;
    goal.target_pose.header.stamp = ros::Time::now();
    goal.target_pose.pose = toMessage(pose);
    client_.sendGoal(goal);
  }

  /// True when the goal is over within that many simulated seconds.
  bool over(double seconds) { return client_.waitForResult(ros::Duration(seconds)); }

  Pose2 pose() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return pose_;
  }
  double speed() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return speed_;
  }
  bool hasTruth() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return has_truth_;
  }

  static bool pauseScan(bool pause, const std::string& topic = "scan") {
    std_srvs::SetBool service;
    service.request.data = pause;
    return ros::service::call("create2_stub/pause_" + topic, service);
  }

  bool eventuallyDrives() {
    return eventually([&] { return speed() > 0.1; });
  }

  /// Simulated seconds until the robot stands.
  double secondsUntilStill() {
    const ros::Time begin = ros::Time::now();
    EXPECT_TRUE(eventually([&] { return speed() < 0.01; }));
    return (ros::Time::now() - begin).toSec();
  }

  actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction> client_;
  LogListener log_;

 private:
  void onTruth(const nav_msgs::Odometry::ConstPtr& truth) {
    const std::lock_guard<std::mutex> lock(mutex_);
    pose_ = fromMessage(truth->pose.pose);
    speed_ = std::abs(truth->twist.twist.linear.x) + 0.1 * std::abs(truth->twist.twist.angular.z);
    has_truth_ = true;
  }
  void onContacts(const std_msgs::UInt32::ConstPtr& contacts) {
    const std::lock_guard<std::mutex> lock(mutex_);
    contact_count_ = contacts->data;
  }

  std::mutex mutex_;
  Pose2 pose_;
  double speed_ = 0.0;
  bool has_truth_ = false;
  unsigned contact_count_ = 0;
  CallbackThread callbacks_;
  ros::Subscriber truth_;
  ros::Subscriber contacts_;
};

}  // namespace lstm_planner
