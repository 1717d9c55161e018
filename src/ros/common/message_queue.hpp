#pragma once

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/node_handle.h>

#include <chrono>
#include <exception>
#include <mutex>
#include <string>

#include "ros/common/repeater.hpp"
#include "ros/common/timing.hpp"

namespace lstm_planner {

/// Keeps the messages of subscriptions until somebody wants them, so that a plugin that is asked twice a second neither
/// wakes up for each scan nor unpacks it. Now and then they are handed out without being wanted: subscriptions whose
/// queues hold a tenth of a second lose nothing, however long nobody asks. Does not depend on the host's spin thread.
/// Must outlive the subscriptions made with its node handles.
class MessageQueue {
 public:
  MessageQueue() : repeater_(kLongestWait, [this] { handOut(); }) {}

  /// A node handle whose messages come here.
  ros::NodeHandle nodeHandle(const std::string& name_space = "") {
    ros::NodeHandle node_handle(name_space);
    node_handle.setCallbackQueue(&queue_);
    return node_handle;
  }

  /// Calls the subscriptions' callbacks with all that has come, in order. Thread safe; not from one of the callbacks.
  void handOut() {
    const std::lock_guard<std::mutex> lock(handing_out_);
    try {
      queue_.callAvailable();
    } catch (const std::exception& error) {
      // tf throws for stamps at the end of time; in a thread of its own nobody else would catch that.
      ROS_ERROR_THROTTLE(kLogPeriod, "a message could not be used: %s", error.what());
    }
  }

 private:
  static constexpr std::chrono::milliseconds kLongestWait{100};

  ros::CallbackQueue queue_;
  std::mutex handing_out_;  ///< one at a time, or messages would change places
  Repeater repeater_;       ///< last: it uses what is above
};

}  // namespace lstm_planner
