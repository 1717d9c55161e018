#pragma once

#include <costmap_2d/costmap_2d_ros.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <nav_core/base_local_planner.h>
#include <ros/time.h>
#include <tf2_ros/buffer.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "lstm_planner/drive/motion/motion_controller.hpp"

namespace diagnostic_updater {
class DiagnosticStatusWrapper;
}

namespace lstm_planner {

class PlanFollower;
class PluginDiagnostics;

/// The local planner plugin for move_base: turns and drives along the plan within the Create 2's limits, slows down
/// near obstacles, and stands still when scan or odometry are too old.
///
/// Subscribes scan and odom (topics are parameters). Publishes /diagnostics, and why the robot stands on "~/" + name +
/// "/status" (diagnostic_msgs/DiagnosticStatus, latched). Obstacles of the costmap that the scan does not show count,
/// too (CostmapReader). Parameters: SteeringControllerParameters, in "~/" + name; some may change while it drives
/// (dynamic_reconfigure). Thread safe; nothing is ever thrown out of it.
class SteeringController : public nav_core::BaseLocalPlanner {
 public:
  SteeringController();
  ~SteeringController() override;

  /// On bad parameters: logs FATAL with the reason; the controller then never moves the robot.
  void initialize(std::string name, tf2_ros::Buffer* tf, costmap_2d::Costmap2DROS* costmap_ros) override;

  /// An empty plan stops the robot.
  bool setPlan(const std::vector<geometry_msgs::PoseStamped>& plan) override;

  /// False, with a zero velocity and a throttled line that says why, when it is not safe to move. True, and such a line
  /// after a second, where an obstacle or a person is in the way.
  bool computeVelocityCommands(geometry_msgs::Twist& cmd_vel) override;

  /// Within the tolerances of the plan's last pose. False while the odometry is too old to tell.
  bool isGoalReached() override;

 private:
  /// What was answered last, and when.
  struct Answer {
    MotionCommand command;
    std::string why;  ///< it stands
    ros::SteadyTime time;
    ros::SteadyTime stopped_since;  ///< zero while it is not stopped
  };

  void setUp(const std::string& name, tf2_ros::Buffer* tf, costmap_2d::Costmap2DROS* costmap_ros);
  void refuse(const std::string& name, const std::string& reason);
  void startDiagnostics(const std::string& name);
  bool isAsked() const;
  void describeStop(diagnostic_updater::DiagnosticStatusWrapper* status) const;
  void describeCommand(diagnostic_updater::DiagnosticStatusWrapper* status) const;
  void noteStop(const MotionCommand& command);
  bool follow(geometry_msgs::Twist* cmd_vel);
  bool stand(StopReason reason, const std::string& why);

  /// Null until initialised, or if not used. Its mutex is taken before the other one.
  std::atomic<costmap_2d::Costmap2DROS*> costmap_{nullptr};
  std::mutex mutex_;
  std::unique_ptr<PlanFollower> plan_follower_;                    ///< null until initialised
  std::string why_unusable_ = "initialize() has not been called";  ///< as long as it is not
  Answer answer_;
  // Last: they ask for what is above.
  std::unique_ptr<PluginDiagnostics> diagnostics_;
  std::shared_ptr<void> reconfigure_;  ///< see serveReconfiguration()
};

}  // namespace lstm_planner
