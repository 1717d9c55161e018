#include "lstm_planner/ros/create2_stub/create2_stub_parameters.hpp"

#include <stdexcept>
#include <utility>

#include "lstm_planner/ros/common/parameter_reader.hpp"

namespace lstm_planner {
Create2StubParameters loadCreate2StubParameters(const ros::NodeHandle& private_node) {
  ParameterReader reader(private_node);
  Create2StubParameters parameters;
  readPose(private_node, "scenario/start", &parameters.start);
  visitCreate2StubParameters(parameters, reader.visitor());
  visitCreate2StubParameters(std::as_const(parameters), RangeCheck{private_node.getNamespace() + "/"});
  validate(parameters.robot);
  validate(parameters.laser);
  validate(parameters.second_laser);
  if (parameters.robot_model != "CREATE_2") {
    throw std::invalid_argument("parameter " + private_node.resolveName("robot_model") + " is '" +
                                parameters.robot_model + "', expected CREATE_2, the only model that is simulated");
  }
  reader.knowGroup("scenario");  // the demo runner's
  reader.warnOfUnknown();
  return parameters;
}

}  // namespace lstm_planner
