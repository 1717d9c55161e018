#pragma once

#include <string>

#include "lstm_planner/simulation/drive.hpp"

namespace lstm_planner {

/// What a file says of a robot, taken over into what a drive is made of: parameters of both plugins, of the base and of
/// the scanner, and the network's file (`model`), in the groups of config/robots/*.yaml. What the file does not say
/// stays as it is.
///
/// `name`: a path, or NAME for config/robots/NAME.yaml. Throws std::invalid_argument for a file that there is not, that
/// has none of these groups or a misspelt one, that names a parameter that there is not or one twice, whose plugins
/// have different footprints, or whose costmaps have a larger one.
void readRobotFile(const std::string& name, DriveParameters* drive, AgentParameters* agent, std::string* model);

}  // namespace lstm_planner
