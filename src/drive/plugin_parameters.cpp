#include "lstm_planner/drive/plugin_parameters.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "lstm_planner/common/nearest_name.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"

namespace lstm_planner {

namespace {

/// What DWAPlannerROS and TrajectoryPlannerROS call parameters of SteeringController, in the same unit.
const std::map<std::string, std::string>& namesOfOtherPlanners() {
  static const std::map<std::string, std::string> names = {
      {"max_vel_x", "max_linear"},
      {"max_vel_trans", "max_linear"},
      {"max_trans_vel", "max_linear"},
      {"max_vel_theta", "max_angular"},
      {"max_rot_vel", "max_angular"},
      {"acc_lim_x", "linear_acceleration"},
      {"acc_lim_trans", "linear_acceleration"},
      {"xy_goal_tolerance", "position_tolerance"},
      {"yaw_goal_tolerance", "heading_tolerance"},
  };
  return names;
}

}  // namespace

void validate(const GlobalPlannerParameters& parameters) {
  visitGlobalPlannerParameters(parameters, RangeCheck());
  validate(parameters.sensors.scan_rules);
  validate(parameters.agent);
  if (parameters.agent.leader == Leader::kGreedy) {
    throw std::invalid_argument("leader is 'none', expected network or route: none is for comparisons in simulation");
  }
}

void validate(const SteeringControllerParameters& parameters) {
  visitSteeringControllerParameters(parameters, RangeCheck());
  validate(parameters.sensors.scan_rules);
  validate(parameters.motion);
  footprintOf(parameters);
  checkRange("controller_frequency", parameters.controller_frequency, 0.1, 1000.0);
}

Footprint footprintOf(const SteeringControllerParameters& parameters) {
  return footprintOf("footprint", parameters.footprint_radius, parameters.footprint);
}

std::vector<std::string> changeableGlobalPlannerParameters() {
  return {"leader",
          "goal_tolerance",
          "goal_in_sight",
          "escape/patience_steps",
          "escape/patience_distance",
          "escape/last_resort",
          "trace_length"};
}

std::vector<std::string> changeableSteeringControllerParameters() {
  return {"max_linear",        "max_angular",    "max_wheel_speed", "linear_acceleration", "wheel_acceleration",
          "lookahead",         "nearest_target", "turn_in_place",   "heading_gain",        "reaction_time",
          "safety_margin",     "slow_gap",       "slow_speed",      "person_speed",        "person_margin",
          "person_slow_speed", "evade_time",     "evade_margin",    "position_tolerance",  "heading_tolerance",
          "plan_timeout"};
}

std::string hintAtParameter(const std::string& name, const std::vector<std::string>& names) {
  const auto same = namesOfOtherPlanners().find(name);
  const bool has_same =
      same != namesOfOtherPlanners().end() && std::find(names.begin(), names.end(), same->second) != names.end();
  return has_same ? "; here it is named " + same->second : hintAt(name, names);
}

}  // namespace lstm_planner
