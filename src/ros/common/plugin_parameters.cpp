#include "lstm_planner/ros/common/plugin_parameters.hpp"

#include <ros/package.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "lstm_planner/ros/common/parameter_reader.hpp"

namespace lstm_planner {

GlobalPlannerParameters loadGlobalPlannerParameters(const ros::NodeHandle& node_handle) {
  GlobalPlannerParameters parameters;
  ParameterReader reader(node_handle);
  visitGlobalPlannerParameters(parameters, reader.visitor());
  reader.warnOfUnknown();

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

std::string resolvedPath(const std::string& path) {
  const std::string scheme = "package://";
  if (path.compare(0, scheme.size(), scheme) == 0) {
    const std::size_t slash = path.find('/', scheme.size());
    const std::string package = path.substr(scheme.size(), slash - scheme.size());
    const std::string folder = ros::package::getPath(package);
    if (folder.empty() || slash == std::string::npos) {
      throw std::invalid_argument("there is no file " + path + ": package '" + package + "' was not found");
    }
    return folder + path.substr(slash);
  }
  if (path == "~" || path.compare(0, 2, "~/") == 0) {
    const char* home = std::getenv("HOME");
    if (home == nullptr) throw std::invalid_argument("there is no file " + path + ": the environment has no HOME");
    return home + path.substr(1);
  }
  return path.empty() ? path : std::filesystem::absolute(path).string();
}

}  // namespace lstm_planner
