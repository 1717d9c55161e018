#include "lstm_planner/ros/common/plugin_parameters.hpp"

#include <ros/package.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/common/parameter_visitors.hpp"
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

SteeringControllerParameters loadSteeringControllerParameters(const ros::NodeHandle& node_handle) {
  SteeringControllerParameters parameters;
  ParameterReader reader(node_handle);
  visitSteeringControllerParameters(parameters, reader.visitor());
  reader.warnOfUnknown();
  ParameterReader(ros::NodeHandle("~")).read("controller_frequency", &parameters.controller_frequency);

  validate(parameters);
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
