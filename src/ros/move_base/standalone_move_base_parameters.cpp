#include "lstm_planner/ros/move_base/standalone_move_base_parameters.hpp"

#include <utility>

#include "lstm_planner/ros/common/parameter_reader.hpp"

namespace lstm_planner {
namespace {

// Parameters of the real move_base that are of no use without a costmap and recovery behaviours; config/move_base.yaml
// sets some of them. Nobody is warned of them.
constexpr const char* kOnlyOfTheRealMoveBase[] = {
    "aggressive_reset",        "clearing_radius",      "clearing_rotation_allowed", "conservative_reset",
    "conservative_reset_dist", "circumscribed_radius", "inscribed_radius",          "make_plan_add_unreachable_goal",
    "make_plan_clear_costmap", "max_planning_retries", "recovery_behavior_enabled", "recovery_behaviors",
    "shutdown_costmaps"};

/// The part of a plugin's name after the package, which is the name of its namespace.
std::string classOf(const std::string& plugin) { return plugin.substr(plugin.find_last_of("/:") + 1); }

}  // namespace

StandaloneMoveBaseParameters loadStandaloneMoveBaseParameters(const ros::NodeHandle& private_node) {
  StandaloneMoveBaseParameters parameters;
  ParameterReader reader(private_node);
  visitStandaloneMoveBaseParameters(parameters, reader.visitor());
  visitStandaloneMoveBaseParameters(std::as_const(parameters), RangeCheck{private_node.getNamespace() + "/"});
  for (const char* name : kOnlyOfTheRealMoveBase) {
    reader.know(name);
    reader.knowGroup(name);
  }
  reader.knowRobotFile();
  reader.knowGroup(classOf(parameters.base_global_planner));
  reader.knowGroup(classOf(parameters.base_local_planner));
  reader.warnOfUnknown();
  return parameters;
}

}  // namespace lstm_planner
