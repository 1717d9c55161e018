#include "lstm_planner/ros/common/transform_listener.hpp"

#include <ros/console.h>

#include <exception>

#include "ros/common/timing.hpp"

namespace lstm_planner {
namespace {

constexpr int kQueue = 100;

void sayLeftOut(const geometry_msgs::TransformStamped& transform, const std::string& publisher, const ros::Time& now) {
  ROS_ERROR_THROTTLE(kLogPeriod,
                     "the transform from %s to %s by %s is not used: it is stamped %.3f s, and the clock says %.3f s",
                     transform.child_frame_id.c_str(), transform.header.frame_id.c_str(), publisher.c_str(),
                     transform.header.stamp.toSec(), now.toSec());
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
  const ros::Time now = ros::Time::now();
  clearIfClockWasSetBack(now);
  for (const auto& transform : event.getConstMessage()->transforms) {
    addMoving(transform, event.getPublisherName(), now);
  }
}

void TransformListener::onStaticTransforms(const ros::MessageEvent<tf2_msgs::TFMessage const>& event) {
  for (const auto& transform : event.getConstMessage()->transforms) add(transform, event.getPublisherName(), true);
}

void TransformListener::clearIfClockWasSetBack(const ros::Time& now) {
  if (now < last_update_) {
    ROS_WARN("the clock was set back by %.3f s: all transforms so far are forgotten",
             last_update_.toSec() - now.toSec());
    buffer_.clear();
    newest_.clear();
  }
  last_update_ = now;
}

void TransformListener::addMoving(const geometry_msgs::TransformStamped& transform, const std::string& publisher,
                                  const ros::Time& now) {
  const double memory = buffer_.getCacheLength().toSec();
  const double stamp = transform.header.stamp.toSec();
  // Zero, before a simulator's clock has come, is no time.
  const auto isAhead = [&](double time) { return !now.isZero() && time > now.toSec() + memory; };
  const auto last = newest_.find(transform.child_frame_id);
  const bool was_sound = last != newest_.end() && !isAhead(last->second.stamp);
  if (stamp > ros::TIME_MAX.toSec() - memory || (isAhead(stamp) && was_sound)) {
    return sayLeftOut(transform, publisher, now);
  }
  if (last != newest_.end() && isAhead(last->second.stamp) && !isAhead(stamp)) {
    ROS_WARN("the transform from %s to %s was stamped %.3f s, and is %.3f s now: all transforms so far are forgotten",
             transform.child_frame_id.c_str(), transform.header.frame_id.c_str(), last->second.stamp, stamp);
    buffer_.clear();
    newest_.clear();
  }
  Child& child = newest_[transform.child_frame_id];
  child.stamp = stamp;
  if (child.publishers.note(publisher, now.toSec())) {
    ROS_WARN("two nodes publish the transform from %s to %s, %s and %s: the newer one counts, so it may jump",
             transform.child_frame_id.c_str(), transform.header.frame_id.c_str(), child.publishers.newest().c_str(),
             child.publishers.other().c_str());
  }
  add(transform, publisher, false);
}

void TransformListener::add(const geometry_msgs::TransformStamped& transform, const std::string& publisher,
                            bool is_static) {
  try {
    buffer_.setTransform(transform, publisher, is_static);
  } catch (const std::exception& error) {
    ROS_ERROR_THROTTLE(kLogPeriod, "the transform from %s to %s by %s is not used: %s",
                       transform.child_frame_id.c_str(), transform.header.frame_id.c_str(), publisher.c_str(),
                       error.what());
  }
}

}  // namespace lstm_planner
