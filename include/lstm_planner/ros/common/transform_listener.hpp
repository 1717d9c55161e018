#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <ros/subscriber.h>
#include <ros/time.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/buffer.h>

#include <map>
#include <memory>
#include <string>

#include "lstm_planner/ros/common/publisher_watch.hpp"

namespace lstm_planner {

/// Fills a buffer from the topics tf and tf_static, as tf2_ros::TransformListener does, and survives any message. A
/// transform stamped farther ahead of the clock than the buffer remembers (10 s by default) makes it forget all others
/// of its frame and refuse new ones until the clock has caught up. It is left out with a sentence when one with a sound
/// stamp came before, and forgotten when one comes after; a publisher whose own clock is ahead is taken. The end of
/// time, for which tf throws, is always left out. A clock that is set back clears the buffer. Two nodes that publish
/// the same transform are named once.
class TransformListener {
 public:
  /// In a thread of its own. `buffer` must outlive the object.
  explicit TransformListener(tf2_ros::Buffer* buffer);

  /// In whatever thread serves the queue of `node_handle`.
  TransformListener(tf2_ros::Buffer* buffer, ros::NodeHandle node_handle);

  TransformListener(const TransformListener&) = delete;
  TransformListener& operator=(const TransformListener&) = delete;

 private:
  void subscribe(ros::NodeHandle node_handle);
  void onTransforms(const ros::MessageEvent<tf2_msgs::TFMessage const>& event);
  void onStaticTransforms(const ros::MessageEvent<tf2_msgs::TFMessage const>& event);
  void clearIfClockWasSetBack(const ros::Time& now);
  void addMoving(const geometry_msgs::TransformStamped& transform, const std::string& publisher, const ros::Time& now);
  void add(const geometry_msgs::TransformStamped& transform, const std::string& publisher, bool is_static);

  tf2_ros::Buffer& buffer_;
  ros::Time last_update_;
  struct Child {
    double stamp = 0.0;  ///< s, of the last transform that was taken
    PublisherWatch publishers;
  };
  std::map<std::string, Child> newest_;  ///< by child frame
  ros::CallbackQueue queue_;
  ros::Subscriber subscriber_;
  ros::Subscriber static_subscriber_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;  ///< null without a thread of its own
};

}  // namespace lstm_planner
