#include "lstm_planner/ros/controller/steering_controller.hpp"

#include <ros/console.h>
#include <ros/node_handle.h>

#include <exception>
#include <pluginlib/class_list_macros.hpp>

#include "lstm_planner/ros/common/costmap_footprint.hpp"
#include "lstm_planner/ros/common/costmap_reader.hpp"
#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "lstm_planner/ros/controller/plan_follower.hpp"

PLUGINLIB_EXPORT_CLASS(lstm_planner::SteeringController, nav_core::BaseLocalPlanner)

namespace lstm_planner {

namespace {

constexpr double kLogPeriod = 2.0;  // s

}  // namespace

SteeringController::SteeringController() = default;

// The costmap may be gone by now: nothing below may know it.
SteeringController::~SteeringController() = default;

void SteeringController::initialize(std::string name, tf2_ros::Buffer* tf, costmap_2d::Costmap2DROS* costmap_ros) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (plan_follower_) {
    ROS_WARN("%s is already initialised, the second call is ignored", name.c_str());
    return;
  }
  if (tf == nullptr || costmap_ros == nullptr) {
    refuse(name, "it was initialised without tf or a costmap");
    return;
  }
  try {
    SteeringControllerParameters parameters = loadSteeringControllerParameters(ros::NodeHandle("~/" + name));
    parameters.footprint_radius =
        safeFootprintRadius(*costmap_ros, parameters.footprint_radius, name + "/footprint_radius");
    plan_follower_ = std::make_unique<PlanFollower>(parameters, costmap_ros->getBaseFrameID(), *tf, costmap_ros);
    costmap_ = parameters.use_costmap ? costmap_ros : nullptr;
  } catch (const std::exception& error) {
    refuse(name, error.what());
  } catch (...) {
    refuse(name, "the reason is not known");
  }
}

void SteeringController::refuse(const std::string& name, const std::string& reason) {
  why_unusable_ = reason;
  ROS_FATAL("%s cannot be used: %s", name.c_str(), reason.c_str());
}

bool SteeringController::setPlan(const std::vector<geometry_msgs::PoseStamped>& plan) {
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    if (plan_follower_) {
      plan_follower_->setPlan(plan);
      return true;
    }
    ROS_ERROR_THROTTLE(kLogPeriod, "the plan is not followed: the controller cannot be used: %s",
                       why_unusable_.c_str());
  } catch (const std::exception& error) {
    ROS_WARN_THROTTLE(kLogPeriod, "the plan is not followed: %s", error.what());
  } catch (...) {
    ROS_ERROR_THROTTLE(kLogPeriod, "the plan is not followed, for an unknown reason");
  }
  return false;
}

bool SteeringController::computeVelocityCommands(geometry_msgs::Twist& cmd_vel) {
  cmd_vel = geometry_msgs::Twist();
  const CostmapLock costmap_lock(costmap_);
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    if (plan_follower_ && plan_follower_->hasPlan()) {
      const Twist2 twist = plan_follower_->compute();
      cmd_vel.linear.x = twist.linear;
      cmd_vel.angular.z = twist.angular;
      return true;
    }
    const std::string reason =
        plan_follower_ ? "there is no plan to follow" : "the controller cannot be used: " + why_unusable_;
    ROS_WARN_THROTTLE(kLogPeriod, "the robot stands: %s", reason.c_str());
  } catch (const std::exception& error) {
    ROS_WARN_THROTTLE(kLogPeriod, "the robot stands: %s", error.what());
  } catch (...) {
    ROS_ERROR_THROTTLE(kLogPeriod, "the robot stands, for an unknown reason");
  }
  return false;
}

bool SteeringController::isGoalReached() {
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    return plan_follower_ && plan_follower_->goalReached();
  } catch (const std::exception& error) {
    ROS_WARN_THROTTLE(kLogPeriod, "whether the goal is reached is not known: %s", error.what());
  } catch (...) {
    ROS_ERROR_THROTTLE(kLogPeriod, "whether the goal is reached is not known");
  }
  return false;
}

}  // namespace lstm_planner
