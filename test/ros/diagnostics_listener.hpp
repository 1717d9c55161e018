#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>

#include <map>
#include <mutex>
#include <string>

#include "ros/callback_thread.hpp"

namespace lstm_planner {

/// The newest statuses on /diagnostics and on a plugin's latched topic.
class DiagnosticsListener {
 public:
  using Status = diagnostic_msgs::DiagnosticStatus;

  explicit DiagnosticsListener(const std::string& plugin)
      : diagnostics_(callbacks_.nodeHandle().subscribe("/diagnostics", 10, &DiagnosticsListener::onDiagnostics, this)),
        status_(callbacks_.nodeHandle("~/" + plugin).subscribe("status", 10, &DiagnosticsListener::onStatus, this)) {}

  /// Of the task whose name, behind the node's, is this; empty before the first.
  Status task(const std::string& name) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return tasks_[ros::this_node::getName().substr(1) + ": " + name];
  }
  Status latched() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return latched_;
  }

  static std::string valueOf(const std::string& key, const Status& status) {
    for (const auto& entry : status.values) {
      if (entry.key == key) return entry.value;
    }
    return "";
  }

 private:
  void onDiagnostics(const diagnostic_msgs::DiagnosticArray::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const Status& status : message->status) tasks_[status.name] = status;
  }
  void onStatus(const Status::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    latched_ = *message;
  }

  std::mutex mutex_;
  std::map<std::string, Status> tasks_;
  Status latched_;
  CallbackThread callbacks_;
  ros::Subscriber diagnostics_;
  ros::Subscriber status_;
};

}  // namespace lstm_planner
