#include "lstm_planner/ros/recorder/teleoperator_parameters.hpp"

#include <stdexcept>

namespace lstm_planner {

TeleoperatorParameters loadTeleoperatorParameters(const ros::NodeHandle& private_node) {
  TeleoperatorParameters parameters;
  ParameterReader reader(private_node);
  visitTeleoperatorParameters(parameters, reader.visitor());
  validate(parameters.driver);
  if (parameters.map.empty()) {
    throw std::invalid_argument("parameter " + private_node.resolveName("map") +
                                " is not set: the driver sees the floor plan, a map_server yaml is needed");
  }
  reader.warnOfUnknown();
  return parameters;
}

}  // namespace lstm_planner
