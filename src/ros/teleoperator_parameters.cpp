#include "lstm_planner/ros/teleoperator_parameters.hpp"

#include <ros/console.h>

#include <stdexcept>

#include "lstm_planner/parameter_check.hpp"
#include "lstm_planner/ros/pose_parameter.hpp"

namespace lstm_planner {
namespace {

void readDriver(ParameterReader* reader, ScriptedDriverParameters* driver) {
  reader->read("driver/speed", &driver->speed);
  reader->read("driver/turn_speed", &driver->turn_speed);
  reader->read("driver/footprint_radius", &driver->footprint_radius);
  reader->read("driver/clearance", &driver->clearance);
  reader->read("driver/comfort", &driver->comfort);
  reader->read("driver/reluctance", &driver->reluctance);
  reader->read("driver/lookahead", &driver->lookahead);
  reader->read("driver/sharp_turn", &driver->sharp_turn);
  reader->read("driver/drives_arcs", &driver->drives_arcs);
  reader->read("driver/shortest_reaction", &driver->shortest_reaction);
  reader->read("driver/longest_reaction", &driver->longest_reaction);
  reader->read("driver/shortest_hold", &driver->shortest_hold);
  reader->read("driver/wander", &driver->wander);
  reader->read("driver/pause_interval", &driver->pause_interval);
  reader->read("driver/longest_pause", &driver->longest_pause);
  reader->read("driver/arrival_distance", &driver->arrival_distance);
}

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
  readDriver(reader, &parameters->driver);
  checkParameter(parameters->goals >= 0, "goals", parameters->goals, "a number that is not negative");
  checkParameter(parameters->rate >= 10.0 && parameters->rate <= 100.0, "rate", parameters->rate, "10 to 100 Hz");
  checkPositive("patience", parameters->patience);
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
