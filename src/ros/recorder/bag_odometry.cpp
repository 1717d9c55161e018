#include "ros/recorder/bag_odometry.hpp"

#include "lstm_planner/ros/common/conversions.hpp"

namespace lstm_planner {

OdometryFromTransforms::OdometryFromTransforms(const std::string& odometry_frame, const std::string& base_frame)
    : odometry_frame_(frameName(odometry_frame)), base_frame_(frameName(base_frame)) {}

std::optional<nav_msgs::Odometry> OdometryFromTransforms::of(const geometry_msgs::TransformStamped& heard,
                                                             const tf2::BufferCore& tf) {
  const ros::Time& stamp = heard.header.stamp;
  if (frameName(heard.header.frame_id) != odometry_frame_ || stamp == last_.header.stamp ||
      !tf.canTransform(odometry_frame_, base_frame_, stamp)) {
    return std::nullopt;
  }
  const geometry_msgs::Transform transform = tf.lookupTransform(odometry_frame_, base_frame_, stamp).transform;
  nav_msgs::Odometry odometry;
  odometry.header.stamp = stamp;
  odometry.header.frame_id = odometry_frame_;
  odometry.child_frame_id = base_frame_;
  odometry.pose.pose = toMessage(fromMessage(transform));
  setTwist(&odometry);
  last_ = odometry;
  return odometry;
}

void OdometryFromTransforms::setTwist(nav_msgs::Odometry* odometry) const {
  const double elapsed = (odometry->header.stamp - last_.header.stamp).toSec();
  if (last_.header.stamp.isZero() || elapsed <= 0.0) return;
  const Pose2 before = fromMessage(last_.pose.pose);
  const Pose2 pose = fromMessage(odometry->pose.pose);
  odometry->twist.twist.linear.x = toLocalFrame(before, {pose.x, pose.y}).x / elapsed;
  odometry->twist.twist.angular.z = normalizeAngle(pose.yaw - before.yaw) / elapsed;
}

}  // namespace lstm_planner
