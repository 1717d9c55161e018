#include "ros/common/goal_listener.hpp"

#include <ros/console.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "lstm_planner/ros/common/conversions.hpp"

namespace lstm_planner {

GoalListener::GoalListener(ros::NodeHandle node_handle, ros::NodeHandle private_node_handle)
    : goal_subscriber_(private_node_handle.subscribe("current_goal", 1, &GoalListener::onGoal, this)),
      planner_goal_subscriber_(private_node_handle.subscribe("planner_goal", 1, &GoalListener::onGoal, this)),
      end_subscriber_(node_handle.subscribe("move_base/result", 1, &GoalListener::onEnd, this)),
      path_end_subscriber_(private_node_handle.subscribe("exe_path/result", 1, &GoalListener::onEnd, this)) {}

void GoalListener::onGoal(const geometry_msgs::PoseStamped::ConstPtr& goal) {
  try {
    const AnnouncedGoal announced{goalFromMessage(*goal), goal->header.stamp};
    const std::lock_guard<std::mutex> lock(mutex_);
    announcement_ = announced;
  } catch (const std::invalid_argument& error) {
    ROS_WARN_THROTTLE(2.0, "an announced goal is not used: %s", error.what());
  }
}

void GoalListener::onEnd(const boost::shared_ptr<ActionEnd const>& end) {
  const std::lock_guard<std::mutex> lock(mutex_);
  has_succeeded_ = has_succeeded_ || end->status.status == actionlib_msgs::GoalStatus::SUCCEEDED;
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
