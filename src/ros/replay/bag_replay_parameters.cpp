#include <stdexcept>
#include <utility>

#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"
#include "lstm_planner/ros/replay/bag_replay.hpp"

namespace lstm_planner {

BagReplayParameters loadBagReplayParameters(const ros::NodeHandle& private_node) {
  BagReplayParameters parameters;
  ParameterReader reader(private_node);
  visitBagReplayParameters(parameters, reader.visitor());
  SensorMount mount;
  reader.know("mount");
  if (readPose(private_node, "mount", &mount.pose)) {
    parameters.drive.mount = mount;
  }
  reader.knowGroup("LstmGlobalPlanner");
  reader.warnOfUnknown();
  parameters.planner = loadGlobalPlannerParameters(ros::NodeHandle(private_node, "LstmGlobalPlanner"));
  if (parameters.bag.empty()) {
    throw std::invalid_argument("parameter " + private_node.resolveName("bag") +
                                " is empty, expected the path of a bag");
  }
  visitBagReplayParameters(std::as_const(parameters), RangeCheck());
  return parameters;
}

}  // namespace lstm_planner
