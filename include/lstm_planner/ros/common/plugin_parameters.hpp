#pragma once

#include <ros/node_handle.h>

#include <string>

#include "lstm_planner/drive/plugin_parameters.hpp"

namespace lstm_planner {

/// Both read the namespace of `node_handle`, warn of parameters there that are not known, and throw
/// std::invalid_argument naming the parameter, its value and what was expected.
GlobalPlannerParameters loadGlobalPlannerParameters(const ros::NodeHandle& node_handle);
SteeringControllerParameters loadSteeringControllerParameters(const ros::NodeHandle& node_handle);

/// The file that a parameter names: package://NAME/PATH, ~/PATH, or a path, which is made absolute: roslaunch starts
/// nodes in another folder than the user's, so messages are to name the whole path. Empty stays empty. Throws
/// std::invalid_argument for an unknown package.
std::string resolvedPath(const std::string& path);

}  // namespace lstm_planner
