#pragma once

#include <costmap_2d/costmap_2d_ros.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <nav_core/base_global_planner.h>
#include <nav_core/base_local_planner.h>
#include <tf2_ros/buffer.h>

#include <mutex>
#include <pluginlib/class_loader.hpp>
#include <string>
#include <vector>

namespace lstm_planner {

using Plan = std::vector<geometry_msgs::PoseStamped>;

/// The two plugins of a StandaloneMoveBase. Nothing a plugin throws leaves this class: it is logged and counts as a
/// failure of the call.
class HostedPlugins {
 public:
  /// Loads and initialises both. Throws std::runtime_error when one cannot be loaded.
  HostedPlugins(const std::string& global_planner, const std::string& local_planner, tf2_ros::Buffer& tf);

  const std::string& globalFrame() const { return planner_costmap_.getGlobalFrameID(); }
  bool robotPose(geometry_msgs::PoseStamped& pose) const { return planner_costmap_.getRobotPose(pose); }

  /// Callable from any thread, one call at a time gets through. An empty plan is a failure.
  bool makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal, Plan& plan);

  /// As ArrivalTeller; empty for a planner that is none.
  std::string besideGoal();

  /// The controller's calls: from one thread.
  bool setPlan(const Plan& plan);
  bool computeVelocity(geometry_msgs::Twist& velocity);
  bool isGoalReached();

 private:
  // A loader must outlive what it loaded, a costmap the plugins that were given it: members are destroyed in reverse.
  pluginlib::ClassLoader<nav_core::BaseGlobalPlanner> planner_loader_;
  pluginlib::ClassLoader<nav_core::BaseLocalPlanner> controller_loader_;
  costmap_2d::Costmap2DROS planner_costmap_;
  costmap_2d::Costmap2DROS controller_costmap_;
  std::mutex planner_mutex_;
  pluginlib::UniquePtr<nav_core::BaseGlobalPlanner> planner_;
  pluginlib::UniquePtr<nav_core::BaseLocalPlanner> controller_;
};

}  // namespace lstm_planner
