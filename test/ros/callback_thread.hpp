#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <string>

namespace lstm_planner {

/// Serves subscriptions in a thread of its own, so that they go on while the host's spin thread is busy (move_base
/// answers make_plan there). Must outlive the subscriptions made with its node handles.
class CallbackThread {
 public:
  CallbackThread() : spinner_(1, &queue_) { spinner_.start(); }
  ~CallbackThread() { spinner_.stop(); }
  CallbackThread(const CallbackThread&) = delete;
  CallbackThread& operator=(const CallbackThread&) = delete;

  /// A node handle whose callbacks run in this thread.
  ros::NodeHandle nodeHandle(const std::string& name_space = "") {
    ros::NodeHandle node_handle(name_space);
    node_handle.setCallbackQueue(&queue_);
    return node_handle;
  }

 private:
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
};

}  // namespace lstm_planner
