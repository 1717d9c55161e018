// What the goal server does outside the action's thread: plans for the planner's thread and for other nodes.

#include <move_base_msgs/MoveBaseActionGoal.h>
#include <ros/ros.h>

#include <cmath>
#include <stdexcept>

#include "ros/move_base/standalone_move_base_goal.hpp"
#include "ros/move_base/standalone_move_base_goal_server.hpp"

namespace lstm_planner {
namespace {

// A service call must not keep the spinning thread, which receives the scan, for long: few neighbours are tried.
constexpr int kRings = 3;
constexpr int kNeighboursPerRing = 8;

}  // namespace

bool StandaloneMoveBase::GoalServer::planFromRobot(const geometry_msgs::PoseStamped& goal, Plan& plan) {
  geometry_msgs::PoseStamped start;
  pose_known_ = plugins_.robotPose(start);
  return pose_known_ && plugins_.makePlan(start, goal, plan);
}

void StandaloneMoveBase::GoalServer::forwardGoal(const geometry_msgs::PoseStamped::ConstPtr& goal) {
  move_base_msgs::MoveBaseActionGoal action_goal;
  action_goal.header.stamp = ros::Time::now();
  action_goal.goal.target_pose = *goal;
  action_goal_publisher_.publish(action_goal);
}

bool StandaloneMoveBase::GoalServer::servePlan(nav_msgs::GetPlan::Request& request,
                                               nav_msgs::GetPlan::Response& response) {
  if (server_.isActive()) {
    ROS_ERROR("make_plan is not served while a goal is active");
    return false;
  }
  try {
    geometry_msgs::PoseStamped start;
    if (!request.start.header.frame_id.empty()) {
      start = goalInFrame(request.start, plugins_.globalFrame(), tf_);
    } else if (!plugins_.robotPose(start)) {
      ROS_ERROR("make_plan: no start was given and the robot's pose is unknown");
      return false;
    }
    const geometry_msgs::PoseStamped goal = goalInFrame(request.goal, plugins_.globalFrame(), tf_);
    planWithinTolerance(start, goal, request.tolerance, response.plan.poses);
    response.plan.header.frame_id = plugins_.globalFrame();
    response.plan.header.stamp = ros::Time::now();
    return true;
  } catch (const std::invalid_argument& exception) {
    ROS_ERROR("make_plan: %s", exception.what());
    return false;
  }
}

bool StandaloneMoveBase::GoalServer::planWithinTolerance(const geometry_msgs::PoseStamped& start,
                                                         const geometry_msgs::PoseStamped& goal, double tolerance,
                                                         Plan& plan) {
  if (plugins_.makePlan(start, goal, plan)) return true;
  plan.clear();
  if (!std::isfinite(tolerance) || tolerance <= 0.0) return false;
  for (int ring = 1; ring <= kRings; ++ring) {
    const double radius = tolerance * ring / kRings;
    for (int neighbour = 0; neighbour < kNeighboursPerRing; ++neighbour) {
      const double direction = 2.0 * M_PI * neighbour / kNeighboursPerRing;
      geometry_msgs::PoseStamped nearby = goal;
      nearby.pose.position.x += radius * std::cos(direction);
      nearby.pose.position.y += radius * std::sin(direction);
      if (plugins_.makePlan(start, nearby, plan)) return true;
    }
  }
  plan.clear();
  return false;
}

}  // namespace lstm_planner
