#pragma once

#include <costmap_2d/costmap_2d_ros.h>
#include <geometry_msgs/PoseStamped.h>

#include <string>
#include <vector>

namespace nav_core {

/// What move_base asks of a global planner plugin: the interface of nav_core, declared anew for distributions that do
/// not have that package. A plugin compiled against it compiles unchanged against nav_core's own header.
class BaseGlobalPlanner {
 public:
  virtual ~BaseGlobalPlanner() = default;

  /// Called once, before any plan is asked for. The parameters of the planner live in "~/" + name.
  virtual void initialize(std::string name, costmap_2d::Costmap2DROS* costmap_ros) = 0;

  /// A plan from start to goal, in the costmap's global frame; false when there is none.
  virtual bool makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                        std::vector<geometry_msgs::PoseStamped>& plan) = 0;

  /// The same with the plan's cost, which is 0 for planners that do not know one.
  virtual bool makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                        std::vector<geometry_msgs::PoseStamped>& plan, double& cost) {
    cost = 0.0;
    return makePlan(start, goal, plan);
  }

 protected:
  BaseGlobalPlanner() = default;
};

}  // namespace nav_core
