#include "lstm_planner/ros/common/plugin_parameters.hpp"

#include <ros/package.h>

#include <stdexcept>
#include <utility>

#include "lstm_planner/base/common/parameter_visitors.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"

namespace lstm_planner {

GlobalPlannerParameters loadGlobalPlannerParameters(const ros::NodeHandle& node_handle) {
  GlobalPlannerParameters parameters;
  ParameterReader reader(node_handle);
  visitGlobalPlannerParameters(parameters, reader.visitor());
  reader.warnOfUnknown();

  visitGlobalPlannerParameters(std::as_const(parameters), RangeCheck());
  parameters.agent = fittedToFootprint(parameters.agent);
  validate(parameters);
  return parameters;
}

void validate(const GlobalPlannerParameters& parameters) {
  visitGlobalPlannerParameters(parameters, RangeCheck());
  validate(parameters.sensors.scan_rules);
  validate(parameters.agent);
  if (parameters.agent.leader == Decision::Source::kGreedy) {
    throw std::invalid_argument("leader is 'none', expected network or route: none is for comparisons in simulation");
  }
}

SteeringControllerParameters loadSteeringControllerParameters(const ros::NodeHandle& node_handle) {
  SteeringControllerParameters parameters;
  ParameterReader reader(node_handle);
  visitSteeringControllerParameters(parameters, reader.visitor());
  reader.warnOfUnknown();
  ParameterReader(ros::NodeHandle("~")).read("controller_frequency", &parameters.controller_frequency);

  validate(parameters);
  return parameters;
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

std::string resolvePackagePath(const std::string& path) {
  const std::string scheme = "package://";
  if (path.compare(0, scheme.size(), scheme) != 0) {
    return path;
  }
  const std::size_t slash = path.find('/', scheme.size());
  const std::string package = path.substr(scheme.size(), slash - scheme.size());
  const std::string folder = ros::package::getPath(package);
  if (folder.empty() || slash == std::string::npos) {
    throw std::invalid_argument("there is no file " + path + ": package '" + package + "' was not found");
  }
  return folder + path.substr(slash);
}

}  // namespace lstm_planner
