#include "lstm_planner/ros/common/plugin_parameters.hpp"

#include <ros/package.h>

#include <stdexcept>

#include "lstm_planner/base/common/parameter_check.hpp"

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
  readScanRules(reader, &sensors->scan_rules);
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
  reader->read("shield/enabled", &parameters->agent.shield_enabled);
  reader->read("memory/enabled", &parameters->agent.memory.enabled);
  reader->read("escape/enabled", &parameters->agent.escape.enabled);
  visitPlannerNumbers(*parameters, reader->numbers());
}

void readParameters(ParameterReader* reader, SteeringControllerParameters* parameters) {
  readSensors(reader, &parameters->sensors);
  visitControllerNumbers(*parameters, reader->numbers());
}

GlobalPlannerParameters loadGlobalPlannerParameters(const ros::NodeHandle& node_handle) {
  GlobalPlannerParameters parameters;
  ParameterReader reader(node_handle);
  readParameters(&reader, &parameters);
  reader.warnOfUnknown();

  visitPlannerNumbers(parameters, RangeCheck());
  validate(parameters.sensors.scan_rules);
  validate(parameters.agent);
  return parameters;
}

SteeringControllerParameters loadSteeringControllerParameters(const ros::NodeHandle& node_handle) {
  SteeringControllerParameters parameters;
  ParameterReader reader(node_handle);
  readParameters(&reader, &parameters);
  reader.warnOfUnknown();
  ParameterReader(ros::NodeHandle("~")).read("controller_frequency", &parameters.controller_frequency);

  visitControllerNumbers(parameters, RangeCheck());
  validate(parameters.sensors.scan_rules);
  validate(parameters.motion);
  checkRange("controller_frequency", parameters.controller_frequency, 0.1, 1000.0);
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
