#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <tf2/buffer_core.h>

#include <optional>
#include <string>

namespace lstm_planner {

/// Makes odometry of the transforms between odometry frame and base.
class OdometryFromTransforms {
 public:
  OdometryFromTransforms(const std::string& odometry_frame, const std::string& base_frame);

  /// `heard`: what `tf` has just been told. Empty when it is not of the odometry frame, is no news, or does not yet
  /// lead to the base.
  std::optional<nav_msgs::Odometry> of(const geometry_msgs::TransformStamped& heard, const tf2::BufferCore& tf);

 private:
  void setTwist(nav_msgs::Odometry* odometry) const;

  std::string odometry_frame_;
  std::string base_frame_;
  nav_msgs::Odometry last_;
};

}  // namespace lstm_planner
