#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>

#include <mutex>
#include <string>

#include "ros/common/repeater.hpp"

namespace lstm_planner {

/// Keeps the messages of subscriptions until somebody wants them, so that a plugin that is asked twice a second neither
/// wakes up for each scan nor unpacks it. Now and then they are handed out without being wanted: subscriptions whose
/// queues hold a tenth of a second lose nothing, however long nobody asks. Does not depend on the host's spin thread.
/// Must outlive the subscriptions made with its node handles.
class MessageQueue {
 public:
  MessageQueue();

  /// A node handle whose messages come here.
  ros::NodeHandle nodeHandle(const std::string& name_space = "");

  /// Calls the subscriptions' callbacks with all that has come, in order. Thread safe; not from one of the callbacks.
  void handOut();

 private:
  ros::CallbackQueue queue_;
  std::mutex handing_out_;  ///< one at a time, or messages would change places
  Repeater repeater_;       ///< last: it uses what is above
};

}  // namespace lstm_planner
