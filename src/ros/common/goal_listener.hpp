#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <mutex>
#include <optional>

#include "lstm_planner/robot/driving/goal_tracker.hpp"

namespace lstm_planner {

/// Hears the goals that the executor accepts: move_base publishes each on ~current_goal. Thread safe.
class GoalListener {
 public:
  /// `private_node_handle`: of the executor, in the thread that the messages come in.
  explicit GoalListener(ros::NodeHandle private_node_handle);

  /// The newest announcement since the last call, if there was any.
  std::optional<GoalInFrame> takeAnnouncement();

 private:
  void onGoal(const geometry_msgs::PoseStamped::ConstPtr& goal);

  std::mutex mutex_;
  std::optional<GoalInFrame> announcement_;
  ros::Subscriber subscriber_;
};

/// Checks a goal and reads it. A zero quaternion is taken as heading 0, with a warning. Throws std::invalid_argument
/// when the goal names no frame or is not finite.
GoalInFrame goalFromMessage(const geometry_msgs::PoseStamped& message);

}  // namespace lstm_planner
