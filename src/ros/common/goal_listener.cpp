#include "ros/common/goal_listener.hpp"

#include <ros/console.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/common/timing.hpp"

namespace lstm_planner {

namespace {

constexpr unsigned kQueue = 10;  // starts and ends in quick succession must not lose their order

}  // namespace

bool isRepeated(const AnnouncedGoal& before, const AnnouncedGoal& announced) {
  constexpr double kSoon = 1.0;  // s
  return sameGoal(before.goal, announced.goal) && before.frame_id == announced.frame_id &&
         before.stamp == announced.stamp && std::abs(secondsBetween(before.heard, announced.heard)) <= kSoon;
}

GoalListener::GoalListener(ros::NodeHandle node_handle, ros::NodeHandle private_node_handle)
    : subscribers_{private_node_handle.subscribe("current_goal", 1, &GoalListener::onGoal, this),
                   private_node_handle.subscribe("planner_goal", 1, &GoalListener::onGoal, this),
                   private_node_handle.subscribe("exe_path/result", 1, &GoalListener::onPathEnd, this)} {
  for (ros::NodeHandle* node : {&node_handle, &private_node_handle}) {
    subscribers_.push_back(node->subscribe("move_base/goal", kQueue, &GoalListener::onStart, this));
    subscribers_.push_back(node->subscribe("move_base/result", kQueue, &GoalListener::onEnd, this));
  }
}

void GoalListener::onGoal(const geometry_msgs::PoseStamped::ConstPtr& goal) {
  try {
    const AnnouncedGoal announced{goalFromMessage(*goal), goal->header.frame_id, goal->header.stamp, ros::Time::now()};
    const std::lock_guard<std::mutex> lock(mutex_);
    announcement_ = announced;
  } catch (const std::invalid_argument& error) {
    ROS_WARN_THROTTLE(2.0, "an announced goal is not used: %s", error.what());
  }
}

void GoalListener::onStart(const boost::shared_ptr<ActionStart const>& /*start*/) {
  const std::lock_guard<std::mutex> lock(mutex_);
  is_driving_ = true;
}

void GoalListener::onEnd(const boost::shared_ptr<ActionEnd const>& end) {
  onPathEnd(end);
  if (isReplaced(end->subject)) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  is_driving_ = false;
  ++drives_;
}

void GoalListener::onPathEnd(const boost::shared_ptr<ActionEnd const>& end) {
  const std::lock_guard<std::mutex> lock(mutex_);
  has_succeeded_ = has_succeeded_ || end->subject.status == actionlib_msgs::GoalStatus::SUCCEEDED;
}

std::optional<long> GoalListener::drive() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return is_driving_ ? std::optional<long>(drives_) : std::nullopt;
}

bool GoalListener::takeSuccess() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(has_succeeded_, false);
}

std::optional<AnnouncedGoal> GoalListener::takeAnnouncement() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(announcement_, std::nullopt);
}

GoalInFrame goalFromMessage(const geometry_msgs::PoseStamped& message) {
  GoalInFrame goal{frameName(message.header.frame_id), fromMessage(message.pose)};
  if (isZero(message.pose.orientation)) {
    ROS_WARN_THROTTLE(2.0, "the goal's orientation is a zero quaternion, taken as heading 0");
    goal.pose.yaw = 0.0;
  }
  if (goal.frame.empty()) {
    throw std::invalid_argument("the goal names no frame");
  }
  if (!isFinite(goal.pose)) {
    throw std::invalid_argument("the goal's pose is not finite");
  }
  return goal;
}

}  // namespace lstm_planner
