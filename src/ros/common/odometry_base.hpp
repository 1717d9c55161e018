#pragma once

#include <tf2/buffer_core.h>
#include <tf2/exceptions.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "lstm_planner/ros/common/scanner_mounts.hpp"

namespace lstm_planner {

/// Pose and speed of the robot's base, from an odometry that is of another part of the robot: the pose is that of
/// child_frame_id (nav_msgs/Odometry), as of a tracking camera in front of the wheels. tf says where the base is.
class OdometryBase {
 public:
  /// `tf` must outlive the object.
  OdometryBase(const tf2::BufferCore& tf, const std::string& base_frame) : tf_(tf), base_frame_(base_frame) {}

  /// The odometry is of this frame; empty: of the base. True if the base is now somewhere else in it, farther than
  /// where a body that tilts over its wheels takes it. While tf does not know it the last place counts, at first that
  /// of the frame itself.
  bool setFrame(const std::string& frame) {
    problem_.clear();
    is_known_ = frame.empty() || frame == base_frame_;
    if (is_known_) return place({});
    try {
      const Pose2 base = mountFromMessage(tf_.lookupTransform(frame, base_frame_, ros::Time(0)).transform).pose;
      is_known_ = isFinite(base);
      return is_known_ && place(base);
    } catch (const tf2::TransformException&) {
      return false;
    } catch (const std::invalid_argument&) {
      problem_ = frame + " is tilted by more than 15 degrees against " + base_frame_;
      return false;
    }
  }

  /// tf connects that frame with the base.
  bool isKnown() const { return is_known_; }
  /// Why an odometry of that frame says nothing of the floor; empty where it does.
  const std::string& problem() const { return problem_; }

  Pose2 poseOf(const Pose2& odometry) const { return compose(odometry, base_); }
  /// `sideways`: the other component of the odometry's speed, m/s.
  Twist2 twistOf(const Twist2& odometry, double sideways) const {
    if (base_.x == 0.0 && base_.y == 0.0 && base_.yaw == 0.0) return odometry;  // and `sideways` may be anything
    const double ahead = odometry.linear - odometry.angular * base_.y;
    const double aside = sideways + odometry.angular * base_.x;
    return {std::cos(base_.yaw) * ahead + std::sin(base_.yaw) * aside, odometry.angular};
  }

 private:
  bool place(const Pose2& base) {
    constexpr double kTilts = 0.1;  // m, rad
    if (differ(base, base_)) base_ = base;
    const bool is_elsewhere = distanceBetween(base, settled_) > kTilts || turnBetween(base, settled_) > kTilts;
    if (is_elsewhere) settled_ = base;
    return is_elsewhere;
  }

  const tf2::BufferCore& tf_;
  std::string base_frame_;
  Pose2 base_;     ///< in the odometry's child frame
  Pose2 settled_;  ///< the same when it was somewhere else last
  bool is_known_ = true;
  std::string problem_;
};

}  // namespace lstm_planner
