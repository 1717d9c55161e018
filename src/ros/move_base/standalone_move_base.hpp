#pragma once

#include <tf2_ros/buffer.h>

#include <memory>

namespace lstm_planner {

/// Hosts a global planner and a controller plugin behind move_base's public ROS interface, for ROS distributions
/// without the navigation stack. What it does with the two plugins is what move_base does: the planner runs in a thread
/// of its own, the controller at a fixed rate while a goal is active. There is no costmap and no recovery behaviour.
///
/// Interface:
///  - action `move_base` (move_base_msgs/MoveBase): goals in any frame that tf connects to the global frame; a goal
///    that cannot be reached is aborted with a text that says why
///  - topic `move_base_simple/goal` (geometry_msgs/PoseStamped), subscribed
///  - topic `~current_goal` (geometry_msgs/PoseStamped): each accepted goal, in the global frame
///  - topic `cmd_vel` (geometry_msgs/Twist): zero once whenever driving ends
///  - service `~make_plan` (nav_msgs/GetPlan): refused while a goal is active
///
/// Parameters (~): standalone_move_base_parameters.hpp, those of the plugins, and in `global_costmap` and
/// `local_costmap` those of costmap_2d::Costmap2DROS in compat/.
class StandaloneMoveBase {
 public:
  /// Reads the parameters, loads both plugins and takes goals from then on. `tf` must outlive the object and be filled
  /// by a listener with a thread of its own. Throws std::runtime_error when a parameter is out of its range or a plugin
  /// cannot be loaded.
  explicit StandaloneMoveBase(tf2_ros::Buffer& tf);

  /// Ends an active goal; safe before and after ros::shutdown().
  ~StandaloneMoveBase();

  StandaloneMoveBase(const StandaloneMoveBase&) = delete;
  StandaloneMoveBase& operator=(const StandaloneMoveBase&) = delete;

 private:
  class GoalServer;
  std::unique_ptr<GoalServer> goal_server_;
};

}  // namespace lstm_planner
