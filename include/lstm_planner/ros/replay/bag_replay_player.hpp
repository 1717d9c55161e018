#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>
#include <rosbag/bag.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <functional>
#include <optional>
#include <string>

#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

/// Plays the scans, odometry, transforms and map of a bag on /clock, scan, odom, /tf, /tf_static and map.
///
/// The clock is the sensors': the recording computer's may differ from theirs, so the message that was on its way for
/// the shortest time is taken to have arrived at its stamp. Where the bag has no transforms of its own, the robot's
/// pose comes from the odometry.
class BagReplayPlayer {
 public:
  /// What of the bag is played. Empty odometry: it has none.
  struct Topics {
    std::string scan;
    std::string odometry;
  };

  /// Throws std::invalid_argument when the bag cannot be read.
  BagReplayPlayer(const std::string& path, const Topics& topics);

  /// The robot's, as the odometry names it; empty where it does not.
  const std::string& baseFrame() const { return base_frame_; }

  /// Tells viewers where the scanner sits, for bags that do not.
  void placeScanner(const SensorMount& mount, const std::string& base_frame);

  /// `rate`: s of the recording in a second, 0 = as fast as possible. `at` is called with the time of the recording
  /// before each of its messages. Ends early when the node is shut down.
  void play(double rate, const std::function<void(const ros::Time&)>& at);

 private:
  void readClock();
  void waitUntil(const ros::Time& time, double rate);
  void tellTime(const ros::Time& time);
  void publish(const rosbag::MessageInstance& message);
  void publishPose(const nav_msgs::Odometry& odometry);

  rosbag::Bag bag_;
  Topics topics_;
  ros::Duration clock_difference_{ros::DURATION_MAX};  ///< recording computer's less the sensors'
  std::string odometry_frame_;
  std::string base_frame_;
  std::string scan_frame_;
  bool has_transforms_ = false;

  ros::NodeHandle node_;
  ros::Publisher clock_;
  ros::Publisher scans_;
  ros::Publisher odometry_;
  ros::Publisher transforms_;
  ros::Publisher map_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  std::optional<ros::Time> began_;  ///< of the recording
  ros::WallTime wall_began_;
};

}  // namespace lstm_planner
