#include <stdexcept>

#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"
#include "lstm_planner/ros/common/pose_parameter.hpp"
#include "lstm_planner/ros/replay/bag_replay.hpp"

namespace lstm_planner {

BagReplayParameters loadBagReplayParameters(const ros::NodeHandle& private_node) {
  BagReplayParameters parameters;
  ParameterReader reader(private_node);
  reader.read("bag", &parameters.bag);
  reader.read("scan_topic", &parameters.drive.scan_topic);
  reader.read("odometry_topic", &parameters.drive.odometry_topic);
  std::string goal_topic;
  reader.read("goal_topic", &goal_topic);
  if (!goal_topic.empty()) {
    parameters.drive.goal_topics = {goal_topic};
  }
  reader.read("odometry_frame", &parameters.drive.odometry_frame);
  reader.read("base_frame", &parameters.drive.base_frame);
  reader.read("hindsight", &parameters.drive.hindsight);
  reader.read("rate", &parameters.rate);
  reader.read("patience", &parameters.patience);
  reader.read("stay", &parameters.stay);
  reader.read("decisions", &parameters.decisions);
  SensorMount mount;
  if (readPose(private_node, "mount", &mount.pose)) {
    parameters.drive.mount = mount;
  }
  parameters.planner = loadGlobalPlannerParameters(ros::NodeHandle(private_node, "LstmGlobalPlanner"));
  if (parameters.bag.empty()) {
    throw std::invalid_argument("parameter " + private_node.resolveName("bag") +
                                " is empty, expected the path of a bag");
  }
  checkRange("rate", parameters.rate, 0.0, 1000.0);
  checkRange("patience", parameters.patience, 0.0, 3600.0);
  return parameters;
}

}  // namespace lstm_planner
