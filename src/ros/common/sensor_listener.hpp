#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/message_event.h>
#include <ros/subscriber.h>
#include <ros/time.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/buffer.h>

#include <mutex>
#include <stdexcept>
#include <string>

#include "lstm_planner/robot/perception/laser_scan.hpp"
#include "lstm_planner/robot/perception/odometry_history.hpp"
#include "lstm_planner/robot/perception/period_meter.hpp"
#include "lstm_planner/robot/perception/silence_watch.hpp"
#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "lstm_planner/ros/common/scanner_mounts.hpp"
#include "ros/common/message_queue.hpp"

namespace lstm_planner {

/// What the sensors say at one moment.
struct SensorReading {
  sensor_msgs::LaserScan::ConstPtr scan;
  double scan_stamp = 0.0;   ///< s; when it was received, where the driver does not stamp its scans
  double scan_period = 0.0;  ///< s, as measured; 0 as long as it is not known
  SensorMount mount;         ///< of the scanner in the base frame
  std::string odometry_frame;
  Pose2 scan_pose;    ///< base in the odometry frame when the scan was taken
  Pose2 newest_pose;  ///< base in the odometry frame, newest
  Twist2 twist;       ///< newest, base frame
  long jumps = 0;     ///< how often the odometry has jumped so far
};

/// How a sensor's messages come.
struct SensorHealth {
  std::string topic;
  double age = 0.0;     ///< s, of the newest message; negative: stamped in the future
  double period = 0.0;  ///< s, as measured; 0 as long as it is not known
  double timeout = 0.0;
  bool is_heard = false;  ///< something has come
};

/// There is no usable reading; what() says why.
class SensorError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Keeps the newest scan and the odometry around it. Never waits for either. Thread safe.
class SensorListener {
 public:
  /// `base_frame` stands in where the odometry does not name the robot's frame. `messages` and `tf` must outlive the
  /// object.
  SensorListener(MessageQueue* messages, const SensorParameters& parameters, const std::string& base_frame,
                 const tf2_ros::Buffer& tf);

  /// Of what has come until now. Throws SensorError when scan or odometry is missing, too old, not finite, the scanner
  /// is covered (SilenceWatch) or its place is not known.
  SensorReading read(const ros::Time& now);

  SensorHealth scanHealth(const ros::Time& now);
  SensorHealth odometryHealth(const ros::Time& now);

 private:
  void onScan(const ros::MessageEvent<sensor_msgs::LaserScan const>& event);
  void onOdometry(const ros::MessageEvent<nav_msgs::Odometry const>& event);
  void checkAges(const ros::Time& now) const;
  void sayTimeoutsOnce();
  double scanTimeout() const;
  double odometryTimeout() const;
  const SensorMount& mountOf(const std::string& frame);

  MessageQueue& messages_;
  SensorParameters parameters_;

  std::mutex mutex_;  ///< guards all below
  ScannerMounts mounts_;
  std::string odometry_frame_;
  sensor_msgs::LaserScan::ConstPtr scan_;
  ros::Time scan_stamp_;
  ros::Time scan_received_;
  LaserScan laser_scan_;  ///< the same
  SilenceWatch silence_;
  PeriodMeter scan_period_;
  ros::Time odometry_stamp_;
  ros::Time odometry_received_;
  PeriodMeter odometry_period_;
  bool timeouts_are_said_ = false;
  bool odometry_is_finite_ = true;
  OdometryHistory history_;

  ros::Subscriber scan_subscriber_;
  ros::Subscriber odometry_subscriber_;
};

}  // namespace lstm_planner
