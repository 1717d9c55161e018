#include "ros/common/odometry_base.hpp"

#include <tf2/exceptions.h>

#include <cmath>
#include <stdexcept>

#include "lstm_planner/ros/common/conversions.hpp"
#include "lstm_planner/ros/common/scanner_mounts.hpp"

namespace lstm_planner {

bool OdometryBase::setFrame(const std::string& frame) {
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

bool OdometryBase::place(const Pose2& base) {
  if (!differ(base, base_)) return false;
  base_ = base;
  return true;
}

Twist2 OdometryBase::twistOf(const Twist2& odometry, double sideways) const {
  if (base_.x == 0.0 && base_.y == 0.0 && base_.yaw == 0.0) return odometry;  // and `sideways` may be anything
  const double ahead = odometry.linear - odometry.angular * base_.y;
  const double aside = sideways + odometry.angular * base_.x;
  return {std::cos(base_.yaw) * ahead + std::sin(base_.yaw) * aside, odometry.angular};
}

}  // namespace lstm_planner
