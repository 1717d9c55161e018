#pragma once

#include <actionlib/server/simple_action_server.h>
#include <geometry_msgs/PoseStamped.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/GetPlan.h>
#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>

#include <atomic>
#include <string>

#include "lstm_planner/ros/move_base/standalone_move_base_parameters.hpp"
#include "ros/common/stopwatch.hpp"
#include "ros/move_base/standalone_move_base.hpp"
#include "ros/move_base/standalone_move_base_planner_thread.hpp"
#include "ros/move_base/standalone_move_base_plugins.hpp"

namespace lstm_planner {

/// Takes the goals and pursues one at a time: looks for a plan, drives along it, looks for a new one when the
/// controller finds no velocity. A goal that takes another one's place does not stop the robot: it drives on along the
/// last plan until there is one to the new goal.
class StandaloneMoveBase::GoalServer {
 public:
  explicit GoalServer(tf2_ros::Buffer& tf);
  ~GoalServer();

 private:
  using Server = actionlib::SimpleActionServer<move_base_msgs::MoveBaseAction>;
  enum class State { kPlanning, kControlling };

  // In the spinning thread.
  void forwardGoal(const geometry_msgs::PoseStamped::ConstPtr& goal);
  bool servePlan(nav_msgs::GetPlan::Request& request, nav_msgs::GetPlan::Response& response);
  bool planWithinTolerance(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                           double tolerance, Plan& plan);

  // In the planner's thread.
  bool planFromRobot(const geometry_msgs::PoseStamped& goal, Plan& plan);

  // In the action's thread. Those that return bool say whether the goal is still pursued.
  void pursue(const move_base_msgs::MoveBaseGoalConstPtr& goal);
  bool start(const move_base_msgs::MoveBaseGoal& goal, State state);
  bool handlePreemption();
  bool step();
  bool takePlan();
  bool waitForPlan();
  bool drive();
  bool mayDriveOn();
  bool recoverController();
  bool isOscillating(const geometry_msgs::PoseStamped& robot);

  void stopRobot();
  void succeed();
  std::string arrivalText() const;
  void abort(const std::string& text);

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  tf2_ros::Buffer& tf_;
  const StandaloneMoveBaseParameters parameters_;
  HostedPlugins plugins_;
  std::atomic<bool> pose_known_{true};
  std::atomic<bool> finished_{false};
  PlannerThread planner_;

  State state_ = State::kPlanning;
  geometry_msgs::PoseStamped goal_;      ///< global frame
  geometry_msgs::PoseStamped plan_end_;  ///< of the last plan to it, global frame
  bool plan_is_to_goal_ = false;         ///< the controller's plan
  Stopwatch last_plan_;                  ///< to this goal or to an earlier one
  Stopwatch last_valid_plan_;            ///< to this goal
  Stopwatch last_valid_control_;
  Stopwatch last_progress_;
  geometry_msgs::PoseStamped progress_pose_;

  ros::Publisher velocity_publisher_;
  ros::Publisher current_goal_publisher_;
  ros::Publisher action_goal_publisher_;
  ros::Subscriber simple_goal_subscriber_;
  ros::ServiceServer plan_service_;
  Server server_;
};

}  // namespace lstm_planner
