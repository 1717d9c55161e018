#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"
#include "lstm_planner/simulation/scripted_driver.hpp"

namespace lstm_planner {

/// What `scripted_teleoperator` reads from its private namespace; config/scripted_teleoperator.yaml explains every
/// parameter.
struct TeleoperatorParameters {
  std::string map;
  double free_threshold = -1.0;
  std::string map_frame = "map";
  std::string base_frame = "base_footprint";
  std::string goal_topic = "dataset_recorder/goal";
  std::vector<NamedPose> waypoints;
  int goals = 0;
  double rate = 20.0;
  double patience = 0.5;
  int seed = 1;
  ScriptedDriverParameters driver;
};

/// Visits every parameter; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitTeleoperatorParameters(Parameters& node, const Visitor& visit) {
  visit("map", node.map, {}, "", "path of the building's map_server yaml; must be set");
  visit("free_threshold", node.free_threshold, {-1.0, 1.0}, "", "replaces the map's free_thresh if it is not negative");
  visit("map_frame", node.map_frame, {}, "", "frame of the map");
  visit("base_frame", node.base_frame, {}, "",
        "the robot's frame; its pose comes from tf if nobody publishes ground_truth");
  visit("goal_topic", node.goal_topic, {}, "", "geometry_msgs/PoseStamped");
  visit("waypoints", node.waypoints, {}, "m",
        "in the map frame; if there are any, the topic is not used, and the node drives to them one after another");
  visit("goals", node.goals, {0, 1000000}, "", "number of goals after which the node ends; 0: never");
  visit("rate", node.rate, {10.0, 100.0}, "Hz", "of commands");
  visit("patience", node.patience, {0.01, 60.0}, "s", "the robot stands while its pose is older than this");
  visit("seed", node.seed, {}, "", "of all random numbers");
  visitDriverParameters(node.driver, withPrefix("driver/", visit));
}

/// Reads the node's private namespace; leaves what is not set at its default. Throws std::invalid_argument naming the
/// parameter, its value and what was expected.
TeleoperatorParameters loadTeleoperatorParameters(const ros::NodeHandle& private_node);

}  // namespace lstm_planner
