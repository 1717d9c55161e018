#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <ros/time.h>

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "lstm_planner/drive/decision/goal_tracker.hpp"
#include "ros/common/action_message.hpp"

namespace lstm_planner {

/// A goal as it was given, and the time at which its frame is meant; ros::Time(0): now.
struct AnnouncedGoal {
  GoalInFrame goal;
  std::string frame_id;  ///< as in the message: tf knows none that begins with a slash
  ros::Time stamp;
  ros::Time heard;
};

/// Whether it is `before`, said again within a second.
bool isRepeated(const AnnouncedGoal& before, const AnnouncedGoal& announced);

/// Hears the goals that the executor accepts, and how its drives begin and end: move_base publishes each goal on
/// ~current_goal; move_base/goal and move_base/result are those of its action. move_base_flex publishes the goal before
/// each plan, on ~current_goal or, since 2024, on ~planner_goal; its action is ~move_base, in which each path is one of
/// ~exe_path. Thread safe.
class GoalListener {
 public:
  /// `node_handle`, `private_node_handle`: of the executor, in the thread that the messages come in.
  GoalListener(ros::NodeHandle node_handle, ros::NodeHandle private_node_handle);

  /// The newest announcement since the last call, if there was any.
  std::optional<AnnouncedGoal> takeAnnouncement();
  /// Whether a goal was reported as reached since the last call.
  bool takeSuccess();
  /// GoalTracker::setDrive()
  std::optional<long> drive();

 private:
  void onGoal(const geometry_msgs::PoseStamped::ConstPtr& goal);
  void onStart(const boost::shared_ptr<ActionStart const>& start);
  void onEnd(const boost::shared_ptr<ActionEnd const>& end);
  void onPathEnd(const boost::shared_ptr<ActionEnd const>& end);

  std::mutex mutex_;
  std::optional<AnnouncedGoal> announcement_;
  bool has_succeeded_ = false;
  bool is_driving_ = false;
  long drives_ = 0;  ///< that have ended
  std::vector<ros::Subscriber> subscribers_;
};

/// Checks a goal and reads it. A zero quaternion is taken as heading 0, with a warning. Throws std::invalid_argument
/// when the goal names no frame or is not finite.
GoalInFrame goalFromMessage(const geometry_msgs::PoseStamped& message);

}  // namespace lstm_planner
