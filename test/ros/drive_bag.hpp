#pragma once

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatus.h>
#include <geometry_msgs/PoseStamped.h>
#include <move_base_msgs/MoveBaseActionGoal.h>
#include <move_base_msgs/MoveBaseActionResult.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <limits>
#include <string>

#include "lstm_planner/base/common/random.hpp"
#include "lstm_planner/ros/common/conversions.hpp"

namespace lstm_planner {

/// tf's messages before tf2: another name, the same definition.
struct OldTransforms : tf2_msgs::TFMessage {};

}  // namespace lstm_planner

namespace ros {
namespace message_traits {
template <>
struct MD5Sum<lstm_planner::OldTransforms> : MD5Sum<tf2_msgs::TFMessage> {
  static const char* value(const lstm_planner::OldTransforms&) { return MD5Sum<tf2_msgs::TFMessage>::value(); }
  static const char* value() { return MD5Sum<tf2_msgs::TFMessage>::value(); }
};
template <>
struct DataType<lstm_planner::OldTransforms> {
  static const char* value() { return "tf/tfMessage"; }
  static const char* value(const lstm_planner::OldTransforms&) { return value(); }
};
template <>
struct Definition<lstm_planner::OldTransforms> {
  static const char* value() { return Definition<tf2_msgs::TFMessage>::value(); }
  static const char* value(const lstm_planner::OldTransforms&) { return value(); }
};
}  // namespace message_traits
namespace serialization {
template <>
struct Serializer<lstm_planner::OldTransforms> {
  template <typename Stream>
  static void write(Stream& stream, const lstm_planner::OldTransforms& message) {
    Serializer<tf2_msgs::TFMessage>::write(stream, message);
  }
  static uint32_t serializedLength(const lstm_planner::OldTransforms& message) {
    return Serializer<tf2_msgs::TFMessage>::serializedLength(message);
  }
};
}  // namespace serialization
}  // namespace ros

namespace lstm_planner {

/// What is in a bag.
struct DriveBagContent {
  std::string scan_topic = "/scan";
  bool odometry = true;
  bool transforms = true;       ///< odom -> base_footprint
  bool old_transforms = false;  ///< of the type tf/tfMessage
  bool mount = true;            ///< base_footprint -> base_scan
  bool goals = true;
  double clock_ahead = 0.0;  ///< s, of the computer that records, before the robot's
};

/// Writes a bag of a robot that drives through a room for half a minute, with everything that ends an episode:
///
/// | s    | goal           | topic                                            | end                                  |
/// |------|----------------|--------------------------------------------------|--------------------------------------|
/// | 0.5  | (4.1, 0)       | move_base_simple/goal, passed on to move_base/goal | arrived after 10 s                 |
/// | 11   | (4, 3)         | move_base/goal                                   | arrived after 9 s                    |
/// | 23   | (-1, 4)        | move_base_simple/goal                            | cancelled at 27 s                    |
/// | 28   | (10, 10)       | move_base/goal                                   | move_base gives it up at 30 s        |
/// | 30.5 | (0, 0)         | move_base_simple/goal                            | the bag's                            |
///
/// Messages are recorded up to 0.15 s after their stamps, not always in the order of these.
class DriveBag {
 public:
  static constexpr double kStart = 1000.0;  // s
  static constexpr double kMount = 0.1;     // m before the base

  static void write(const std::string& path, const DriveBagContent& content = {}) { DriveBag(path, content).drive(); }

 private:
  static constexpr double kTick = 0.05;  // s

  DriveBag(const std::string& path, const DriveBagContent& content)
      : bag_(path, rosbag::bagmode::Write), content_(content) {}

  void drive() {
    if (content_.mount) writeMount();
    move(1.0, {0.0, 0.0});
    move(10.0, {0.4, 0.0});
    move(2.0, {0.0, M_PI_4});
    move(7.5, {0.4, 0.0});
    move(3.0, {0.0, 0.0});
    move(8.5, {0.4, 0.3});
    if (content_.goals) writeGoals();
    bag_.close();
  }

  ros::Time after(double seconds) const { return ros::Time(kStart + seconds); }
  /// When what is sent at `seconds` is recorded, at the least.
  ros::Time received(double seconds) const { return after(seconds + content_.clock_ahead); }
  /// Odometry is first.
  double latency() { return ticks_ < 2 ? 0.01 : 0.01 + uniform(random_, 0.0, 0.14); }

  void move(double seconds, const Twist2& twist) {
    const long ticks = std::lround(seconds / kTick);
    for (long i = 0; i < ticks; ++i, ++ticks_) {
      const double now = static_cast<double>(ticks_) * kTick;
      if (ticks_ % 2 == 0) {
        writeOdometry(now, twist);
      } else {
        writeScan(now);
      }
      pose_.x += kTick * twist.linear * std::cos(pose_.yaw);
      pose_.y += kTick * twist.linear * std::sin(pose_.yaw);
      pose_.yaw += kTick * twist.angular;
    }
  }

  void writeMount() {
    tf2_msgs::TFMessage message;
    message.transforms = {toMessage({kMount, 0.0, 0.0}, "base_footprint", "base_scan", after(0.0))};
    bag_.write("/tf_static", received(0.0), message);
  }

  void writeOdometry(double now, const Twist2& twist) {
    nav_msgs::Odometry odometry;
    odometry.header.stamp = after(now);
    odometry.header.frame_id = "odom";
    odometry.child_frame_id = "base_footprint";
    odometry.pose.pose = toMessage(pose_);
    odometry.twist.twist.linear.x = twist.linear;
    odometry.twist.twist.angular.z = twist.angular;
    const ros::Time recorded = received(now + latency());
    if (content_.odometry) bag_.write("/odom", recorded, odometry);
    if (!content_.transforms) return;
    OldTransforms message;
    message.transforms = {toMessage(pose_, "odom", "base_footprint", after(now))};
    if (content_.old_transforms) {
      bag_.write("/tf", recorded, message);
    } else {
      bag_.write("/tf", recorded, static_cast<const tf2_msgs::TFMessage&>(message));
    }
  }

  /// The walls of a room of 12 x 11 m.
  static double rangeFrom(const Point2& place, double direction) {
    const double along_x = ((std::cos(direction) > 0.0 ? 9.0 : -3.0) - place.x) / std::cos(direction);
    const double along_y = ((std::sin(direction) > 0.0 ? 8.0 : -3.0) - place.y) / std::sin(direction);
    return std::min(std::abs(along_x), std::abs(along_y));
  }

  void writeScan(double now) {
    sensor_msgs::LaserScan scan;
    scan.header.stamp = after(now);
    scan.header.frame_id = "base_scan";
    scan.angle_min = static_cast<float>(-M_PI_2);
    scan.angle_max = static_cast<float>(M_PI_2);
    scan.angle_increment = static_cast<float>(M_PI / 180.0);
    scan.range_min = 0.1f;
    scan.range_max = 30.0f;
    const Point2 place = pointAlong(pose_, pose_.yaw, kMount);
    for (int i = 0; i <= 180; ++i) {
      const double direction = pose_.yaw + scan.angle_min + i * scan.angle_increment;
      const bool is_lost = i % 17 == 0;
      scan.ranges.push_back(is_lost ? std::numeric_limits<float>::quiet_NaN()
                                    : static_cast<float>(rangeFrom(place, direction)));
    }
    bag_.write(content_.scan_topic, received(now + latency()), scan);
  }

  geometry_msgs::PoseStamped goal(double now, double x, double y) const {
    geometry_msgs::PoseStamped goal;
    goal.header.stamp = after(now);
    goal.header.frame_id = "odom";
    goal.pose = toMessage({x, y, 0.0});
    return goal;
  }

  void writeSimpleGoal(double now, double x, double y) {
    bag_.write("/move_base_simple/goal", received(now), goal(now, x, y));
  }

  void writeActionGoal(double now, const std::string& id, const geometry_msgs::PoseStamped& goal) {
    move_base_msgs::MoveBaseActionGoal action;
    action.header.stamp = after(now);
    action.goal_id.id = id;
    action.goal_id.stamp = after(now);
    action.goal.target_pose = goal;
    bag_.write("/move_base/goal", received(now), action);
  }

  void writeGoals() {
    writeSimpleGoal(0.5, 4.1, 0.0);
    writeActionGoal(0.52, "a", goal(0.5, 4.1, 0.0));
    writeActionGoal(11.0, "b", goal(11.0, 4.0, 3.0));
    writeSimpleGoal(23.0, -1.0, 4.0);
    bag_.write("/move_base/cancel", received(27.0), actionlib_msgs::GoalID());
    writeActionGoal(28.0, "d", goal(28.0, 10.0, 10.0));
    move_base_msgs::MoveBaseActionResult result;
    result.header.stamp = after(30.0);
    result.status.goal_id.id = "d";
    result.status.status = actionlib_msgs::GoalStatus::ABORTED;
    bag_.write("/move_base/result", received(30.0), result);
    writeSimpleGoal(30.5, 0.0, 0.0);
  }

  rosbag::Bag bag_;
  DriveBagContent content_;
  Random random_{7};
  Pose2 pose_;
  long ticks_ = 0;
};

}  // namespace lstm_planner
