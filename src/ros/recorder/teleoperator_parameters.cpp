#include "lstm_planner/ros/recorder/teleoperator_parameters.hpp"

#include <ros/console.h>

#include <stdexcept>

#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/ros/common/pose_parameter.hpp"

namespace lstm_planner {
namespace {

}  // namespace

void readParameters(ParameterReader* reader, TeleoperatorParameters* parameters) {
  reader->read("free_threshold", &parameters->free_threshold);
  reader->read("map_frame", &parameters->map_frame);
  reader->read("base_frame", &parameters->base_frame);
  reader->read("goal_topic", &parameters->goal_topic);
  std::vector<XmlRpc::XmlRpcValue> way_points;
  reader->read("way_points", &way_points);
  for (std::size_t i = 0; i < way_points.size(); ++i) {
    const Pose2 pose = poseFromParameter(way_points[i], "way_points[" + std::to_string(i) + "]");
    parameters->way_points.push_back({pose.x, pose.y});
  }
  reader->read("goals", &parameters->goals);
  reader->read("rate", &parameters->rate);
  reader->read("patience", &parameters->patience);
  reader->read("seed", &parameters->seed);
  visitDriverNumbers(parameters->driver, reader->numbers("driver/"));
  visitDriverNumbers(parameters->driver, RangeCheck{"driver/"});
  reader->read("driver/drives_arcs", &parameters->driver.drives_arcs);
  checkRange("free_threshold", parameters->free_threshold, -1.0, 1.0);
  checkRange("goals", parameters->goals, 0, 1000000);
  checkRange("rate", parameters->rate, 10.0, 100.0);
  checkRange("patience", parameters->patience, 0.01, 60.0);
  validate(parameters->driver);
}

TeleoperatorParameters loadTeleoperatorParameters(const ros::NodeHandle& private_node) {
  TeleoperatorParameters parameters;
  ParameterReader reader(private_node);
  readParameters(&reader, &parameters);
  reader.read("map", &parameters.map);
  if (parameters.map.empty()) {
    throw std::invalid_argument("parameter " + private_node.resolveName("map") +
                                " is not set: the driver sees the floor plan, a map_server yaml is needed");
  }
  for (const std::string& name : reader.unknownParameters()) ROS_WARN("there is no parameter %s", name.c_str());
  return parameters;
}

}  // namespace lstm_planner
