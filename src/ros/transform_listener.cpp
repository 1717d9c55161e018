#include "lstm_planner/ros/transform_listener.hpp"

#include <ros/console.h>

#include <algorithm>
#include <exception>

namespace lstm_planner {
namespace {

constexpr int kQueue = 100;
constexpr double kLogPeriod = 2.0;  // s

/// The stamp (s) up to which a buffer can take transforms. Zero, before a simulator's clock has come, is no time.
double latestUsable(const ros::Time& now, const ros::Duration& memory) {
  const double latest = ros::TIME_MAX.toSec() - memory.toSec();
  return now.isZero() ? latest : std::min(latest, now.toSec() + memory.toSec());
}

}  // namespace

TransformListener::TransformListener(tf2_ros::Buffer* buffer) : buffer_(*buffer) {
  ros::NodeHandle node_handle;
  node_handle.setCallbackQueue(&queue_);
  subscribe(node_handle);
  buffer_.setUsingDedicatedThread(true);
  spinner_ = std::make_unique<ros::AsyncSpinner>(1, &queue_);
  spinner_->start();
}

TransformListener::TransformListener(tf2_ros::Buffer* buffer, ros::NodeHandle node_handle) : buffer_(*buffer) {
  subscribe(node_handle);
}

void TransformListener::subscribe(ros::NodeHandle node_handle) {
  // Small messages would otherwise wait some 40 ms for each other.
  const auto hints = ros::TransportHints().tcpNoDelay();
  subscriber_ = node_handle.subscribe("/tf", kQueue, &TransformListener::onTransforms, this, hints);
  static_subscriber_ = node_handle.subscribe("/tf_static", kQueue, &TransformListener::onStaticTransforms, this, hints);
}

void TransformListener::onTransforms(const ros::MessageEvent<tf2_msgs::TFMessage const>& event) {
  clearIfClockWasSetBack(ros::Time::now());
  for (const auto& transform : event.getConstMessage()->transforms) add(transform, event.getPublisherName(), false);
}

void TransformListener::onStaticTransforms(const ros::MessageEvent<tf2_msgs::TFMessage const>& event) {
  for (const auto& transform : event.getConstMessage()->transforms) add(transform, event.getPublisherName(), true);
}

void TransformListener::clearIfClockWasSetBack(const ros::Time& now) {
  if (now < last_update_) {
    ROS_WARN("the clock was set back by %.3f s: all transforms so far are forgotten",
             last_update_.toSec() - now.toSec());
    buffer_.clear();
  }
  last_update_ = now;
}

void TransformListener::add(const geometry_msgs::TransformStamped& transform, const std::string& publisher,
                            bool is_static) {
  const double stamp = transform.header.stamp.toSec();
  const ros::Time now = ros::Time::now();
  if (!is_static && stamp > latestUsable(now, buffer_.getCacheLength())) {
    ROS_ERROR_THROTTLE(
        kLogPeriod, "the transform from %s to %s by %s is not used: it is stamped %.3f s, and the clock says %.3f s",
        transform.child_frame_id.c_str(), transform.header.frame_id.c_str(), publisher.c_str(), stamp, now.toSec());
    return;
  }
  try {
    buffer_.setTransform(transform, publisher, is_static);
  } catch (const std::exception& error) {
    ROS_ERROR_THROTTLE(kLogPeriod, "the transform from %s to %s by %s is not used: %s",
                       transform.child_frame_id.c_str(), transform.header.frame_id.c_str(), publisher.c_str(),
                       error.what());
  }
}

}  // namespace lstm_planner
