#include "ros/move_base/standalone_move_base_parameters.hpp"

#include <stdexcept>

#include "lstm_planner/base/common/parameter_check.hpp"

namespace lstm_planner {
namespace {

void loadNumber(const ros::NodeHandle& node, const std::string& name, double least, double most, double& value) {
  if (node.hasParam(name) && !node.getParam(name, value)) {
    throw std::invalid_argument("parameter " + node.resolveName(name) + " is no number");
  }
  checkRange(node.resolveName(name), value, least, most);
}

}  // namespace

StandaloneMoveBaseParameters StandaloneMoveBaseParameters::load(const ros::NodeHandle& node) {
  StandaloneMoveBaseParameters parameters;
  node.getParam("base_global_planner", parameters.base_global_planner);
  node.getParam("base_local_planner", parameters.base_local_planner);
  loadNumber(node, "planner_frequency", 0.0, 1000.0, parameters.planner_frequency);
  loadNumber(node, "controller_frequency", 0.1, 1000.0, parameters.controller_frequency);
  loadNumber(node, "planner_patience", 0.0, 86400.0, parameters.planner_patience);
  loadNumber(node, "controller_patience", 0.0, 86400.0, parameters.controller_patience);
  loadNumber(node, "oscillation_timeout", 0.0, 86400.0, parameters.oscillation_timeout);
  loadNumber(node, "oscillation_distance", 0.001, 1000.0, parameters.oscillation_distance);
  return parameters;
}

}  // namespace lstm_planner
