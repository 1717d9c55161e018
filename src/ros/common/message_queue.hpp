#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace lstm_planner {

/// Keeps the messages of subscriptions until somebody wants them, so that a plugin that is asked twice a second neither
/// wakes up for each scan nor unpacks it. Now and then they are handed out without being wanted: subscriptions whose
/// queues hold a tenth of a second lose nothing, however long nobody asks. Does not depend on the host's spin thread.
/// Must outlive the subscriptions made with its node handles.
class MessageQueue {
 public:
  MessageQueue();
  ~MessageQueue();
  MessageQueue(const MessageQueue&) = delete;
  MessageQueue& operator=(const MessageQueue&) = delete;

  /// A node handle whose messages come here.
  ros::NodeHandle nodeHandle(const std::string& name_space = "");

  /// Calls the subscriptions' callbacks with all that has come, in order. Thread safe; not from one of the callbacks.
  void handOut();

 private:
  void handOutNowAndThen();

  ros::CallbackQueue queue_;
  std::mutex handing_out_;  ///< one at a time, or messages would change places
  std::mutex mutex_;        ///< guards finished_
  std::condition_variable finishes_;
  bool finished_ = false;
  std::thread thread_;
};

}  // namespace lstm_planner
