#pragma once

#include <ros/node_handle.h>

#include <string>

namespace lstm_planner {

/// The parameters of StandaloneMoveBase; see its header for their meaning.
struct StandaloneMoveBaseParameters {
  std::string base_global_planner = "lstm_planner/LstmGlobalPlanner";
  std::string base_local_planner = "lstm_planner/SteeringController";
  double planner_frequency = 0.0;      // Hz
  double controller_frequency = 20.0;  // Hz
  double planner_patience = 5.0;       // s
  double controller_patience = 15.0;   // s
  double oscillation_timeout = 0.0;    // s
  double oscillation_distance = 0.5;   // m

  /// Throws std::invalid_argument naming the parameter, its value and what was expected.
  static StandaloneMoveBaseParameters load(const ros::NodeHandle& node);
};

}  // namespace lstm_planner
