#pragma once

#include <costmap_2d/costmap_2d_ros.h>
#include <geometry_msgs/PoseStamped.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2_ros/transform_listener.h>

#include <boost/make_shared.hpp>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "lstm_planner/base/common/geometry.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/plugin_loader.hpp"
#include "ros/process_figures.hpp"

namespace lstm_planner {

/// Both plugins, loaded, made and asked as move_base does, but in lock step with whoever calls: no thread and no clock
/// of its own. Their parameters are in the private namespace, and "~/costmap".
class PluginHost {
 public:
  enum class State { kDriving, kReached, kNoPlan, kNoCommand };

  /// `publish`: publishes the transform from the costmap's frame to the robot.
  explicit PluginHost(const std::function<void()>& publish) {
    publish();
    transforms_.callAvailable();
    costmap_ = std::make_unique<costmap_2d::Costmap2DROS>("costmap", tf_);
    planner_ = planner_loader_->createInstance("lstm_planner/LstmGlobalPlanner");
    planner_->initialize("LstmGlobalPlanner", costmap_.get());
    controller_ = controller_loader_->createInstance("lstm_planner/SteeringController");
    controller_->initialize("SteeringController", &tf_, costmap_.get());
  }

  void drive(const geometry_msgs::PoseStamped& goal) {
    goal_ = goal;
    periods_without_plan_ = 0;
    periods_without_command_ = 0;
    goals_.publish(boost::make_shared<geometry_msgs::PoseStamped>(goal));
    controller_->setPlan({});
  }

  /// One period of the controller.
  State step(Twist2* command) {
    transforms_.callAvailable();
    *command = {};
    if (period_++ % kPlanEvery == 0 && makePlan(goal_)) {
      periods_without_plan_ = 0;
      controller_->setPlan(plan_);
    }
    if (++periods_without_plan_ > kPatienceForPlan) return State::kNoPlan;
    if (controller_->isGoalReached()) return State::kReached;
    geometry_msgs::Twist velocity;
    if (controller_->computeVelocityCommands(velocity)) {
      periods_without_command_ = 0;
      *command = {velocity.linear.x, velocity.angular.z};
    }
    return ++periods_without_command_ > kPatienceForCommand ? State::kNoCommand : State::kDriving;
  }

  /// Somebody asks for a plan to elsewhere.
  bool makePlan(const geometry_msgs::PoseStamped& goal) {
    geometry_msgs::PoseStamped start;
    if (!costmap_->getRobotPose(start)) return false;
    const double begin = threadTime();
    const bool made = planner_->makePlan(start, goal, plan_);
    plan_times_.push_back(threadTime() - begin);
    return made;
  }

  const tf2_ros::Buffer& tf() const { return tf_; }

  /// s of processor time of each call to the planner since this was asked last.
  std::vector<double> takePlanTimes() { return std::exchange(plan_times_, {}); }

 private:
  static constexpr long kPlanEvery = 4;             ///< periods: 5 Hz, as shipped
  static constexpr long kPatienceForPlan = 160;     ///< periods, 8 s
  static constexpr long kPatienceForCommand = 300;  ///< periods, 15 s

  ros::NodeHandle nodeForTransforms() {
    ros::NodeHandle node;
    node.setCallbackQueue(&transforms_);
    return node;
  }

  ros::CallbackQueue transforms_;
  tf2_ros::Buffer tf_;
  tf2_ros::TransformListener tf_listener_{tf_, nodeForTransforms(), false};
  std::unique_ptr<costmap_2d::Costmap2DROS> costmap_;
  ros::Publisher goals_ = ros::NodeHandle("~").advertise<geometry_msgs::PoseStamped>("current_goal", 1);
  std::unique_ptr<PlannerLoader> planner_loader_ = plannerLoader();
  std::unique_ptr<ControllerLoader> controller_loader_ = controllerLoader();
  boost::shared_ptr<nav_core::BaseGlobalPlanner> planner_;
  boost::shared_ptr<nav_core::BaseLocalPlanner> controller_;

  geometry_msgs::PoseStamped goal_;
  std::vector<geometry_msgs::PoseStamped> plan_;
  std::vector<double> plan_times_;
  long period_ = 0;
  long periods_without_plan_ = 0;
  long periods_without_command_ = 0;
};

}  // namespace lstm_planner
