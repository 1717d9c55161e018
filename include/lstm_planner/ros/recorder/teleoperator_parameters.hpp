#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "lstm_planner/base/common/geometry.hpp"
#include "lstm_planner/robot/simulation/scripted_driver.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"

namespace lstm_planner {

/// What `scripted_teleoperator` reads from its private namespace; config/scripted_teleoperator.yaml explains every
/// parameter.
struct TeleoperatorParameters {
  std::string map;               ///< path of the map's yaml; not in the yaml of parameters
  double free_threshold = -1.0;  ///< replaces the map's free_thresh when not negative
  std::string map_frame = "map";
  std::string base_frame = "base_footprint";
  std::string goal_topic = "dataset_recorder/goal";
  std::vector<Point2> way_points;  ///< map frame; the goals when there are any, one after another
  int goals = 0;                   ///< goals after which the node ends; 0: never
  double rate = 20.0;              ///< Hz of commands
  double patience = 0.5;           ///< s; an older pose is not driven by
  int seed = 1;
  ScriptedDriverParameters driver;
};

/// Leaves what is not set at its default. Throws std::invalid_argument naming the parameter, its value and what was
/// expected.
void readParameters(ParameterReader* reader, TeleoperatorParameters* parameters);

/// The same from the node's private namespace, and the map.
TeleoperatorParameters loadTeleoperatorParameters(const ros::NodeHandle& private_node);

}  // namespace lstm_planner
