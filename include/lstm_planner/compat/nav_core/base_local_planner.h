#pragma once

#include <costmap_2d/costmap_2d_ros.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <tf2_ros/buffer.h>

#include <string>
#include <vector>

namespace nav_core {

/// What move_base asks of a local planner (controller) plugin: the interface of nav_core, declared anew for
/// distributions that do not have that package.
class BaseLocalPlanner {
 public:
  virtual ~BaseLocalPlanner() = default;

  /// Called once, before anything else. The parameters of the controller live in "~/" + name.
  virtual void initialize(std::string name, tf2_ros::Buffer* tf, costmap_2d::Costmap2DROS* costmap_ros) = 0;

  /// The plan to follow from now on; false when it cannot be followed.
  virtual bool setPlan(const std::vector<geometry_msgs::PoseStamped>& plan) = 0;

  /// The velocity to drive with now (base frame, m/s and rad/s); false when no safe one was found.
  virtual bool computeVelocityCommands(geometry_msgs::Twist& cmd_vel) = 0;

  /// True when the robot stands at the end of the plan.
  virtual bool isGoalReached() = 0;

 protected:
  BaseLocalPlanner() = default;
};

}  // namespace nav_core
