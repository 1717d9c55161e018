#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/waiting.hpp"

namespace lstm_planner {

/// Of the odometry; tf itself throws for such a stamp.
inline tf2_msgs::TFMessage transformAtTheEndOfTime() {
  tf2_msgs::TFMessage message;
  message.transforms.emplace_back();
  message.transforms[0].header.stamp = ros::TIME_MAX;
  message.transforms[0].header.frame_id = "odom";
  message.transforms[0].child_frame_id = "base_footprint";
  message.transforms[0].transform.rotation.w = 1.0;
  return message;
}

/// Publishes what a robot with a scanner would, at poses and times that the test sets. The clock stands still in
/// between.
class FakeRobot {
 public:
  FakeRobot()
      : scan_publisher_(node_handle_.advertise<sensor_msgs::LaserScan>("scan", 10)),
        odometry_publisher_(node_handle_.advertise<nav_msgs::Odometry>("odom", 10)) {
    ros::Time::setNow(ros::Time(100.0));
    placeScanner("laser", {0.1, 0.0, 0.0}, false);
    placeOdometry({5.0, -2.0, M_PI_2});
  }

  /// Transform base_link -> frame.
  void placeScanner(const std::string& frame, const Pose2& mount, bool upside_down) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = "base_footprint";
    transform.child_frame_id = frame;
    transform.transform.translation.x = mount.x;
    transform.transform.translation.y = mount.y;
    if (upside_down) {
      transform.transform.rotation.x = std::cos(0.5 * mount.yaw);
      transform.transform.rotation.y = std::sin(0.5 * mount.yaw);
    } else {
      transform.transform.rotation = toMessage(mount).orientation;
    }
    static_broadcaster_.sendTransform(transform);
  }

  /// Transform map -> odom.
  void placeOdometry(const Pose2& odometry_in_map) {
    odometry_in_map_ = odometry_in_map;
    static_broadcaster_.sendTransform(transformTo("map", "odom", odometry_in_map));
  }
  const Pose2& odometryInMap() const { return odometry_in_map_; }

  /// Time passes; nothing is published.
  void wait(double seconds) { ros::Time::setNow(ros::Time::now() + ros::Duration(seconds)); }

  /// Stands at `pose` after `seconds`, with odometry, tf and a scan of that moment.
  void moveTo(const Pose2& pose, double seconds) {
    wait(seconds);
    pose_ = pose;
    publishOdometry();
    publishScan();
  }
  void again() { moveTo(pose_, 0.05); }

  void publishOdometry() {
    broadcaster_.sendTransform(transformTo("odom", "base_footprint", isFinite(pose_) ? pose_ : Pose2()));
    nav_msgs::Odometry odometry;
    odometry.header.frame_id = "odom";
    odometry.header.stamp = ros::Time::now();
    odometry.child_frame_id = "base_footprint";
    odometry.pose.pose = toMessage(pose_);
    alter_odometry(&odometry);
    odometry_publisher_.publish(odometry);
  }

  /// 270 degrees, 1 a beam, the same range all around except where a test says otherwise.
  void publishScan() {
    sensor_msgs::LaserScan scan;
    scan.header.frame_id = scan_frame;
    scan.header.stamp = ros::Time::now();
    scan.angle_min = static_cast<float>(-0.5 * scan_span);
    scan.angle_increment = static_cast<float>(M_PI / 180.0);
    scan.angle_max = static_cast<float>(0.5 * scan_span);
    scan.range_min = 0.023F;
    scan.range_max = static_cast<float>(range_max);
    for (double angle = -0.5 * scan_span; angle <= 0.5 * scan_span; angle += M_PI / 180.0) {
      scan.ranges.push_back(range(angle));
    }
    alter_scan(&scan);
    scan_publisher_.publish(scan);
  }

  const Pose2& pose() const { return pose_; }

  std::string scan_frame = "laser";
  double scan_span = 1.5 * M_PI;
  double range_max = 30.0;
  /// What is wrong with the messages.
  std::function<void(sensor_msgs::LaserScan*)> alter_scan = [](sensor_msgs::LaserScan*) {};
  std::function<void(nav_msgs::Odometry*)> alter_odometry = [](nav_msgs::Odometry*) {};
  std::function<float(double)> range = [](double angle) { return static_cast<float>(4.0 + angle); };

 private:
  static geometry_msgs::TransformStamped transformTo(const std::string& parent, const std::string& child,
                                                     const Pose2& pose) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = parent;
    transform.header.stamp = ros::Time::now();
    transform.child_frame_id = child;
    transform.transform.translation.x = pose.x;
    transform.transform.translation.y = pose.y;
    transform.transform.rotation = toMessage(pose).orientation;
    return transform;
  }

  ros::NodeHandle node_handle_;
  ros::Publisher scan_publisher_;
  ros::Publisher odometry_publisher_;
  tf2_ros::TransformBroadcaster broadcaster_;
  tf2_ros::StaticTransformBroadcaster static_broadcaster_;
  Pose2 pose_;
  Pose2 odometry_in_map_;
};

}  // namespace lstm_planner
