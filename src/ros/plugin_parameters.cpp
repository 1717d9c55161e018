#include "lstm_planner/ros/plugin_parameters.hpp"

#include <ros/package.h>

#include <stdexcept>

#include "lstm_planner/parameter_check.hpp"

namespace lstm_planner {

void readScanRules(ParameterReader* reader, ScanRules* rules) {
  std::string no_return = noReturnText(*rules);
  reader->read("no_return", &no_return);
  setNoReturn(no_return, rules);
  reader->read("least_measured", &rules->least_measured);
}

namespace {

void readSensors(ParameterReader* reader, SensorParameters* sensors) {
  reader->read("scan_topic", &sensors->scan_topic);
  reader->read("odom_topic", &sensors->odom_topic);
  reader->read("scan_timeout", &sensors->scan_timeout);
  reader->read("odom_timeout", &sensors->odom_timeout);
  reader->read("tf_timeout", &sensors->tf_timeout);
  reader->read("max_speed", &sensors->max_speed);
  readScanRules(reader, &sensors->scan_rules);
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

void readMemory(ParameterReader* reader, MemoryParameters* memory) {
  reader->read("memory/enabled", &memory->enabled);
  reader->read("memory/width", &memory->width);
  reader->read("memory/resolution", &memory->resolution);
  reader->read("memory/reach", &memory->reach);
  reader->read("memory/comfort", &memory->comfort);
  reader->read("memory/tightness", &memory->tightness);
}

void readEscape(ParameterReader* reader, EscapeParameters* escape) {
  reader->read("escape/enabled", &escape->enabled);
  reader->read("escape/patience_steps", &escape->patience_steps);
  reader->read("escape/patience_distance", &escape->patience_distance);
  reader->read("escape/last_resort", &escape->last_resort);
  reader->read("escape/progress", &escape->progress);
  reader->read("escape/follow_step", &escape->follow_step);
  reader->read("escape/probe_angle", &escape->probe_angle);
  reader->read("escape/wall_turn", &escape->wall_turn);
  reader->read("escape/leave_margin", &escape->leave_margin);
  reader->read("escape/first_leg", &escape->first_leg);
  reader->read("escape/loop_tolerance", &escape->loop_tolerance);
  reader->read("escape/loop_length", &escape->loop_length);
}

void readMoving(ParameterReader* reader, MovingReturnsParameters* moving) {
  reader->read("moving/range", &moving->range);
  reader->read("moving/youngest", &moving->youngest);
  reader->read("moving/oldest", &moving->oldest);
  reader->read("moving/range_margin", &moving->range_margin);
  reader->read("moving/lateral_margin", &moving->lateral_margin);
  reader->read("moving/angle_margin", &moving->angle_margin);
  reader->read("moving/fewest_beams", &moving->fewest_beams);
  reader->read("moving/hold", &moving->hold);
}

void readMotion(ParameterReader* reader, MotionParameters* motion) {
  reader->read("max_linear", &motion->max_linear);
  reader->read("max_angular", &motion->max_angular);
  reader->read("max_wheel_speed", &motion->max_wheel_speed);
  reader->read("axle_length", &motion->axle_length);
  reader->read("linear_acceleration", &motion->linear_acceleration);
  reader->read("lookahead", &motion->lookahead);
  reader->read("nearest_target", &motion->nearest_target);
  reader->read("turn_in_place", &motion->turn_in_place);
  reader->read("heading_gain", &motion->heading_gain);
  reader->read("reaction_time", &motion->reaction_time);
  reader->read("safety_margin", &motion->safety_margin);
  reader->read("slow_gap", &motion->slow_gap);
  reader->read("slow_speed", &motion->slow_speed);
  readMoving(reader, &motion->moving);
  reader->read("person_speed", &motion->person_speed);
  reader->read("person_margin", &motion->person_margin);
  reader->read("position_tolerance", &motion->position_tolerance);
  reader->read("heading_tolerance", &motion->heading_tolerance);
}

void check(const SensorParameters& sensors) {
  checkPositive("scan_timeout", sensors.scan_timeout);
  checkPositive("odom_timeout", sensors.odom_timeout);
  checkParameter(sensors.tf_timeout >= 0.0, "tf_timeout", sensors.tf_timeout, "0 or more");
  checkPositive("max_speed", sensors.max_speed);
  validate(sensors.scan_rules);
}

void readLeader(ParameterReader* reader, Leader* leader) {
  std::string name = toString(*leader);
  reader->read("leader", &name);
  *leader = leaderNamed(name);
  if (*leader == Leader::kNone) {
    throw std::invalid_argument("leader is 'none', expected network or route: none is for comparisons in simulation");
  }
}

}  // namespace

void readParameters(ParameterReader* reader, GlobalPlannerParameters* parameters) {
  readLeader(reader, &parameters->agent.leader);
  reader->read("model", &parameters->model);
  readSensors(reader, &parameters->sensors);
  readStep(reader, &parameters->agent.step);
  readShield(reader, &parameters->agent);
  readMemory(reader, &parameters->agent.memory);
  readEscape(reader, &parameters->agent.escape);
  reader->read("goal_tolerance", &parameters->agent.goal_tolerance);
  reader->read("goal_in_sight", &parameters->agent.goal_in_sight);
  reader->read("goal_drift", &parameters->agent.goal_drift);
  reader->read("rollout/spacing", &parameters->rollout.spacing);
  reader->read("rollout/steps", &parameters->rollout.steps);
  reader->read("trace_length", &parameters->trace_length);
}

void readParameters(ParameterReader* reader, SteeringControllerParameters* parameters) {
  readSensors(reader, &parameters->sensors);
  readMotion(reader, &parameters->motion);
  reader->read("plan_timeout", &parameters->plan_timeout);
  reader->read("footprint_radius", &parameters->footprint_radius);
}

GlobalPlannerParameters loadGlobalPlannerParameters(const ros::NodeHandle& node_handle) {
  GlobalPlannerParameters parameters;
  ParameterReader reader(node_handle);
  readParameters(&reader, &parameters);
  reader.warnOfUnknown();

  check(parameters.sensors);
  validate(parameters.agent);
  checkPositive("rollout/spacing", parameters.rollout.spacing);
  checkParameter(parameters.rollout.steps >= 0, "rollout/steps", parameters.rollout.steps, "0 or more");
  checkParameter(parameters.trace_length >= 0, "trace_length", parameters.trace_length, "0 or more");
  return parameters;
}

SteeringControllerParameters loadSteeringControllerParameters(const ros::NodeHandle& node_handle) {
  SteeringControllerParameters parameters;
  ParameterReader reader(node_handle);
  readParameters(&reader, &parameters);
  reader.warnOfUnknown();
  ParameterReader(ros::NodeHandle("~")).read("controller_frequency", &parameters.controller_frequency);

  check(parameters.sensors);
  validate(parameters.motion);
  checkPositive("footprint_radius", parameters.footprint_radius);
  checkParameter(parameters.plan_timeout >= 0.0, "plan_timeout", parameters.plan_timeout, "0 or more");
  checkPositive("controller_frequency", parameters.controller_frequency);
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
