#include "lstm_planner/ros/plugin_parameters.hpp"

#include <ros/console.h>
#include <ros/package.h>

#include <cmath>
#include <stdexcept>

#include "lstm_planner/ros/parameter_reader.hpp"

namespace lstm_planner {

namespace {

void expectPositive(const std::string& name, double value) {
  if (!std::isfinite(value) || value <= 0.0) {
    throw std::invalid_argument("parameter " + name + " is " + std::to_string(value) + ", expected a positive number");
  }
}

void expectNotNegative(const std::string& name, int value) {
  if (value < 0) {
    throw std::invalid_argument("parameter " + name + " is " + std::to_string(value) + ", expected 0 or more");
  }
}

void readSensors(ParameterReader* reader, SensorParameters* sensors) {
  reader->read("scan_topic", &sensors->scan_topic);
  reader->read("odom_topic", &sensors->odom_topic);
  reader->read("scan_timeout", &sensors->scan_timeout);
  reader->read("odom_timeout", &sensors->odom_timeout);
  reader->read("max_speed", &sensors->max_speed);
  expectPositive("scan_timeout", sensors->scan_timeout);
  expectPositive("odom_timeout", sensors->odom_timeout);
  expectPositive("max_speed", sensors->max_speed);
}

void readStep(ParameterReader* reader, StepParameters* step) {
  reader->read("step/length", &step->length);
  reader->read("step/turn", &step->turn);
  reader->read("step/period", &step->period);
  reader->read("step/reached", &step->reached);
  reader->read("step/stall", &step->stall);
  reader->read("step/still_distance", &step->still_distance);
  reader->read("step/still_turn", &step->still_turn);
}

void readShield(ParameterReader* reader, AgentParameters* agent) {
  reader->read("shield/enabled", &agent->shield_enabled);
  reader->read("shield/footprint_radius", &agent->shield.footprint_radius);
  reader->read("shield/clearance", &agent->shield.clearance);
  reader->read("shield/tight_clearance", &agent->shield.tight_clearance);
  reader->read("shield/shortest_step", &agent->shield.shortest_step);
  reader->read("shield/reach", &agent->shield.reach);
}

void readEscape(ParameterReader* reader, EscapeParameters* escape) {
  reader->read("escape/enabled", &escape->enabled);
  reader->read("escape/patience_steps", &escape->patience_steps);
  reader->read("escape/patience_distance", &escape->patience_distance);
  reader->read("escape/progress", &escape->progress);
  reader->read("escape/follow_step", &escape->follow_step);
  reader->read("escape/probe_angle", &escape->probe_angle);
  reader->read("escape/wall_turn", &escape->wall_turn);
  reader->read("escape/leave_margin", &escape->leave_margin);
  reader->read("escape/first_leg", &escape->first_leg);
  reader->read("escape/loop_tolerance", &escape->loop_tolerance);
  reader->read("escape/loop_length", &escape->loop_length);
}

void readMotion(ParameterReader* reader, MotionParameters* motion) {
  reader->read("max_linear", &motion->max_linear);
  reader->read("max_angular", &motion->max_angular);
  reader->read("linear_acceleration", &motion->linear_acceleration);
  reader->read("lookahead", &motion->lookahead);
  reader->read("nearest_target", &motion->nearest_target);
  reader->read("turn_in_place", &motion->turn_in_place);
  reader->read("heading_gain", &motion->heading_gain);
  reader->read("reaction_time", &motion->reaction_time);
  reader->read("safety_margin", &motion->safety_margin);
  reader->read("slow_gap", &motion->slow_gap);
  reader->read("slow_speed", &motion->slow_speed);
  reader->read("position_tolerance", &motion->position_tolerance);
  reader->read("heading_tolerance", &motion->heading_tolerance);
}

void warnOfUnknown(const ParameterReader& reader) {
  for (const std::string& name : reader.unknownParameters()) {
    ROS_WARN("parameter %s is set, but there is none of that name", name.c_str());
  }
}

}  // namespace

GlobalPlannerParameters loadGlobalPlannerParameters(const ros::NodeHandle& node_handle) {
  GlobalPlannerParameters parameters;
  ParameterReader reader(node_handle);
  reader.read("model", &parameters.model);
  readSensors(&reader, &parameters.sensors);
  readStep(&reader, &parameters.agent.step);
  readShield(&reader, &parameters.agent);
  readEscape(&reader, &parameters.agent.escape);
  reader.read("goal_tolerance", &parameters.agent.goal_tolerance);
  reader.read("goal_in_sight", &parameters.agent.goal_in_sight);
  reader.read("rollout/spacing", &parameters.rollout.spacing);
  reader.read("rollout/steps", &parameters.rollout.steps);
  reader.read("trace_length", &parameters.trace_length);
  warnOfUnknown(reader);

  validate(parameters.agent);
  expectPositive("rollout/spacing", parameters.rollout.spacing);
  expectNotNegative("rollout/steps", parameters.rollout.steps);
  expectNotNegative("trace_length", parameters.trace_length);
  return parameters;
}

SteeringControllerParameters loadSteeringControllerParameters(const ros::NodeHandle& node_handle) {
  SteeringControllerParameters parameters;
  ParameterReader reader(node_handle);
  readSensors(&reader, &parameters.sensors);
  readMotion(&reader, &parameters.motion);
  reader.read("plan_timeout", &parameters.plan_timeout);
  reader.read("footprint_radius", &parameters.footprint_radius);
  warnOfUnknown(reader);
  ParameterReader(ros::NodeHandle("~")).read("controller_frequency", &parameters.controller_frequency);

  validate(parameters.motion);
  expectPositive("footprint_radius", parameters.footprint_radius);
  if (!(parameters.plan_timeout >= 0.0)) {
    throw std::invalid_argument("parameter plan_timeout is " + std::to_string(parameters.plan_timeout) +
                                ", expected 0 or more");
  }
  expectPositive("controller_frequency", parameters.controller_frequency);
  return parameters;
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
