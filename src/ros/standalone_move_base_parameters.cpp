#include "standalone_move_base_parameters.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace lstm_planner {
namespace {

void loadNumber(const ros::NodeHandle& node, const std::string& name, bool zero_allowed, double& value) {
  if (node.hasParam(name) && !node.getParam(name, value)) {
    throw std::runtime_error("parameter " + node.resolveName(name) + " is no number");
  }
  if (std::isfinite(value) && (value > 0.0 || (zero_allowed && value == 0.0))) return;
  std::ostringstream message;
  message << "parameter " << node.resolveName(name) << " is " << value << ", expected a number "
          << (zero_allowed ? "not below 0" : "above 0");
  throw std::runtime_error(message.str());
}

}  // namespace

StandaloneMoveBaseParameters StandaloneMoveBaseParameters::load(const ros::NodeHandle& node) {
  StandaloneMoveBaseParameters parameters;
  node.getParam("base_global_planner", parameters.base_global_planner);
  node.getParam("base_local_planner", parameters.base_local_planner);
  loadNumber(node, "planner_frequency", true, parameters.planner_frequency);
  loadNumber(node, "controller_frequency", false, parameters.controller_frequency);
  loadNumber(node, "planner_patience", true, parameters.planner_patience);
  loadNumber(node, "controller_patience", true, parameters.controller_patience);
  loadNumber(node, "oscillation_timeout", true, parameters.oscillation_timeout);
  loadNumber(node, "oscillation_distance", false, parameters.oscillation_distance);
  return parameters;
}

}  // namespace lstm_planner
