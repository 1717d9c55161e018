#pragma once

#include <ros/node_handle.h>

#include <string>

#include "lstm_planner/drive/plugin_parameters.hpp"

namespace lstm_planner {

/// Both read the namespace of `node_handle`, warn of parameters there that are not known, and throw
/// std::invalid_argument naming the parameter, its value and what was expected.
GlobalPlannerParameters loadGlobalPlannerParameters(const ros::NodeHandle& node_handle);
SteeringControllerParameters loadSteeringControllerParameters(const ros::NodeHandle& node_handle);

/// The file behind package://NAME/PATH; any other path as it is. Throws std::invalid_argument for an unknown package.
std::string resolvePackagePath(const std::string& path);

}  // namespace lstm_planner
