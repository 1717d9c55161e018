// Gives goals to scripted_teleoperator, which drives create2_stub through the demo building, and watches.
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <std_msgs/UInt32.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "lstm_planner/ros/common/conversions.hpp"
#include "lstm_planner/ros/recorder/teleoperator_parameters.hpp"
#include "ros/fixtures/fake_robot.hpp"
#include "ros/fixtures/ros_program.hpp"
#include "ros/fixtures/yaml_differences.hpp"

namespace lstm_planner::scripted_teleoperator_drives {
namespace {

constexpr double kDeadline = 60.0;        // s of the computer's clock after which a test has failed
constexpr double kArrival = 0.15 + 0.05;  // m, within which the driver lets go of the keys, and the braking

class ScriptedTeleoperator : public ::testing::Test {
 protected:
  ScriptedTeleoperator() {
    truth_subscriber_ = node_.subscribe("create2_stub/ground_truth", 100, &ScriptedTeleoperator::onTruth, this);
    contacts_subscriber_ = node_.subscribe("create2_stub/contacts", 10, &ScriptedTeleoperator::onContacts, this);
    command_subscriber_ = node_.subscribe("cmd_vel", 1000, &ScriptedTeleoperator::onCommand, this);
  }

  void onTruth(const nav_msgs::Odometry::ConstPtr& message) {
    pose_ = fromMessage(message->pose.pose);
    speed_ = message->twist.twist.linear.x;
  }
  void onContacts(const std_msgs::UInt32::ConstPtr& message) { contacts_ = static_cast<int>(message->data); }
  void onCommand(const geometry_msgs::Twist::ConstPtr& message) {
    command_ = {message->linear.x, message->angular.z};
    ++commands_;
  }

  static bool waitUntil(const std::function<bool()>& condition) {
    return eventually(condition, kDeadline, spinBriefly);
  }

  bool waitUntilAt(const Point2& place) {
    return waitUntil(
        [&] { return distanceBetween(pose_, place) < kArrival && command_.linear == 0.0 && command_.angular == 0.0; });
  }

  static geometry_msgs::PoseStamped goalAt(const std::string& frame, const Point2& place) {
    return toMessage({place.x, place.y, 0.0}, frame, ros::Time::now());
  }

  ros::NodeHandle node_;
  Pose2 pose_{1e6, 1e6, 0.0};
  Twist2 command_{1.0, 0.0};
  double speed_ = 0.0;
  int contacts_ = -1;
  long commands_ = 0;
  ros::Subscriber truth_subscriber_;
  ros::Subscriber contacts_subscriber_;
  ros::Subscriber command_subscriber_;
};

TEST_F(ScriptedTeleoperator, DrivesToGoalsOfATopicInAnyFrameWithoutContacts) {
  ros::Publisher goals = node_.advertise<geometry_msgs::PoseStamped>("dataset_recorder/goal", 1, true);
  ASSERT_TRUE(waitUntil([&] { return goals.getNumSubscribers() > 0 && contacts_ == 0 && pose_.x < 1e5; }));
  goals.publish(goalAt("map", {6.5, 1.25}));
  EXPECT_TRUE(waitUntilAt({6.5, 1.25}));
  goals.publish(goalAt("map", {6.5, 8.25}));
  EXPECT_TRUE(waitUntilAt({6.5, 8.25}));
  // Odometry starts at (1.5, 2.5), looking along the map's y axis.
  goals.publish(goalAt("odom", {5.75, -0.5}));
  EXPECT_TRUE(waitUntilAt({2.0, 8.25}));
  EXPECT_EQ(contacts_, 0);
}

TEST_F(ScriptedTeleoperator, CommandsOftenEnoughForTheLatchAndStopsWhenTheGoalsSourceHasGone) {
  ros::Publisher goals = node_.advertise<geometry_msgs::PoseStamped>("dataset_recorder/goal", 1, true);
  ASSERT_TRUE(waitUntil([&] { return goals.getNumSubscribers() > 0 && pose_.x < 1e5; }));
  goals.publish(goalAt("map", {15.2, 10.5}));
  ASSERT_TRUE(waitUntil([&] { return speed_ > 0.2; }));
  const ros::Time begin = ros::Time::now();
  const long commands = commands_;
  ASSERT_TRUE(waitUntil([&] { return ros::Time::now() - begin > ros::Duration(2.0); }));
  // 20 Hz of simulated time; the clock ticks a hundred times a second, so up to one tick is lost each time.
  EXPECT_GT(static_cast<double>(commands_ - commands) / (ros::Time::now() - begin).toSec(), 1.0 / (0.05 + 0.01));
  goals.shutdown();
  EXPECT_TRUE(waitUntil([&] { return command_.linear == 0.0 && command_.angular == 0.0 && std::abs(speed_) < 0.01; }));
  const long commands_in_the_end = commands_;
  const ros::Time end = ros::Time::now();
  ASSERT_TRUE(waitUntil([&] { return ros::Time::now() - end > ros::Duration(2.0); }));
  EXPECT_LE(commands_, commands_in_the_end + 1) << "it keeps quiet without a goal";
  EXPECT_EQ(contacts_, 0);
}

TEST_F(ScriptedTeleoperator, DrivesToItsOwnWaypointsAndEnds) {
  std::vector<std::string> announced;
  const auto goals = node_.subscribe<geometry_msgs::PoseStamped>(
      "scripted_teleoperator/goal", 10,
      [&](const geometry_msgs::PoseStamped::ConstPtr& goal) { announced.push_back(goal->header.frame_id); });
  ASSERT_TRUE(waitUntil([&] { return command_subscriber_.getNumPublishers() == 1; }));
  ros::Publisher transforms = node_.advertise<tf2_msgs::TFMessage>("/tf", 10);
  ASSERT_TRUE(waitUntil([&] { return transforms.getNumSubscribers() > 0; }));
  transforms.publish(transformAtTheEndOfTime());
  EXPECT_TRUE(waitUntilAt({1.5, 2.0})) << "the second of two waypoints";
  EXPECT_TRUE(waitUntil([&] { return command_subscriber_.getNumPublishers() == 0; })) << "it does not end";
  EXPECT_EQ(command_.linear, 0.0);
  EXPECT_EQ(contacts_, 0);
  ASSERT_FALSE(announced.empty());
  EXPECT_EQ(announced.front(), "map");
}

TEST(ScriptedTeleoperatorYaml, ListsEveryParameterWithItsDefault) {
  const auto yaml = yamlDifferences<TeleoperatorParameters>(
      ros::NodeHandle("~yaml"), [](auto& p, const auto& visit) { visitTeleoperatorParameters(p, visit); });
  EXPECT_EQ(yaml.missing, std::set<std::string>{"map"}) << "which building it is, is said where it is started";
  EXPECT_EQ(yaml.changed, std::set<std::string>());
  EXPECT_EQ(yaml.unknown, std::vector<std::string>()) << "in the yaml, but not a parameter";
}

const RosProgram program("scripted_teleoperator_drives", &runTests);

}  // namespace
}  // namespace lstm_planner::scripted_teleoperator_drives
