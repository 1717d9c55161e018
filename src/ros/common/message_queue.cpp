#include "ros/common/message_queue.hpp"

#include <ros/console.h>

#include <chrono>
#include <exception>

#include "ros/common/timing.hpp"

namespace lstm_planner {
namespace {

constexpr std::chrono::milliseconds kLongestWait(100);

}  // namespace

MessageQueue::MessageQueue() : repeater_(kLongestWait, [this] { handOut(); }) {}

ros::NodeHandle MessageQueue::nodeHandle(const std::string& name_space) {
  ros::NodeHandle node_handle(name_space);
  node_handle.setCallbackQueue(&queue_);
  return node_handle;
}

void MessageQueue::handOut() {
  const std::lock_guard<std::mutex> lock(handing_out_);
  try {
    queue_.callAvailable();
  } catch (const std::exception& error) {
    // tf throws for stamps at the end of time; in a thread of its own nobody else would catch that.
    ROS_ERROR_THROTTLE(kLogPeriod, "a message could not be used: %s", error.what());
  }
}

}  // namespace lstm_planner
