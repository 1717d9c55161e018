#pragma once

#include <ros/ros.h>

#include <boost/function.hpp>
#include <string>
#include <vector>

#include "lstm_planner/ros/recorder/drive_messages.hpp"

namespace lstm_planner {

/// Has guard(message, hear) called, as subscribeToDrive(), where hear() calls hear(message, time of now).
template <typename Message, typename Guard, typename Hear>
ros::Subscriber subscribeGuarded(const std::string& topic, std::uint32_t queue, const Guard& guard, const Hear& hear) {
  const boost::function<void(const boost::shared_ptr<const Message>&)> work = [=](const auto& message) {
    guard(*message, [&] { hear(*message, ros::Time::now()); });
  };
  // Without tcpNoDelay, TCP holds a scan back until the one before is acknowledged: up to 40 ms.
  return ros::NodeHandle().subscribe<Message>(topic, queue, work, ros::VoidConstPtr(),
                                              ros::TransportHints().tcpNoDelay());
}

/// Has `messages`, which must outlive the result, hear a drive: scan, odometry, goals and what else is said to
/// move_base and by it. `goals`: topics of geometry_msgs/PoseStamped. Calls guard(message, hear), which is to call
/// hear() and must not throw.
template <typename Guard>
std::vector<ros::Subscriber> subscribeToDrive(const std::string& scan, const std::string& odometry,
                                              const std::vector<std::string>& goals, DriveMessages* messages,
                                              const Guard& guard) {
  // Five seconds of a fast scanner, and more of odometry: the disk may be slow at times.
  constexpr std::uint32_t kScanQueue = 200;
  constexpr std::uint32_t kOdometryQueue = 1000;
  constexpr std::uint32_t kGoalQueue = 20;
  const auto hear = [=](const auto& message, const ros::Time& now) { messages->hear(message, now); };
  const auto goalOf = [=](const auto& goal, const ros::Time& now) { messages->hear(goal, "move_base/goal", now); };
  std::vector<ros::Subscriber> subscribers = {
      subscribeGuarded<sensor_msgs::LaserScan>(scan, kScanQueue, guard, hear),
      subscribeGuarded<nav_msgs::Odometry>(odometry, kOdometryQueue, guard, hear),
      subscribeGuarded<move_base_msgs::MoveBaseActionGoal>("move_base/goal", kGoalQueue, guard, goalOf),
      subscribeGuarded<actionlib_msgs::GoalID>("move_base/cancel", kGoalQueue, guard, hear),
      subscribeGuarded<move_base_msgs::MoveBaseActionResult>("move_base/result", kGoalQueue, guard, hear)};
  for (const std::string& topic : goals) {
    subscribers.push_back(subscribeGuarded<geometry_msgs::PoseStamped>(
        topic, kGoalQueue, guard,
        [=](const auto& goal, const ros::Time& now) { messages->hearGoal(goal, topic, now); }));
  }
  return subscribers;
}

}  // namespace lstm_planner
