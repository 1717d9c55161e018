#pragma once

#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/time.h>

#include <cmath>
#include <string>

#include "lstm_planner/drive/perception/tf_watch.hpp"
#include "ros/common/frame_transformer.hpp"
#include "ros/common/sensor_listener.hpp"

namespace lstm_planner {

/// Says once that tf has the pose of another odometry than the odometry's topic (TfWatch).
class TfCheck {
 public:
  /// `frames` must outlive the object. `odometry_topic`: as the parameter has it.
  TfCheck(const FrameTransformer& frames, const std::string& base_frame, const std::string& odometry_topic)
      : frames_(frames), base_frame_(base_frame), odometry_topic_(ros::NodeHandle().resolveName(odometry_topic)) {}

  void note(const SensorReading& reading, const ros::Time& now) {
    const auto by_tf = frames_.transformThen(reading.odometry_frame, base_frame_, ros::Time(stamp_));
    if (by_tf && watch_.note(stamp_, by_topic_, *by_tf, reading.twist.linear)) warn(*by_tf, reading.odometry_frame);
    constexpr double kLatest = 1.0;  // s that tf may come after the scan
    if (!by_tf && std::abs(now.toSec() - stamp_) <= kLatest) return;
    stamp_ = reading.first.stamp;
    by_topic_ = reading.first.pose;
  }

 private:
  void warn(const Pose2& by_tf, const std::string& frame) const {
    ROS_WARN_ONCE(
        "tf says (%.2f, %.2f) m, %s says (%.2f, %.2f) m of the robot in %s at the same time: tf has the pose of "
        "another odometry, such as an EKF's. Set odom_topic to the topic of that one, or switch off its transform: "
        "until then the costmaps have obstacles beside where they are",
        by_tf.x, by_tf.y, odometry_topic_.c_str(), by_topic_.x, by_topic_.y, frame.c_str());
  }

  const FrameTransformer& frames_;
  std::string base_frame_;
  std::string odometry_topic_;
  TfWatch watch_;
  // Of an earlier scan: tf may know of it later than the topic.
  double stamp_ = 0.0;  ///< s
  Pose2 by_topic_;
};

}  // namespace lstm_planner
