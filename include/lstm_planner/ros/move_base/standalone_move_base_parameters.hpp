#pragma once

#include <string>

namespace lstm_planner {

/// What `standalone_move_base` reads from its private namespace, under the names and with the defaults of move_base;
/// config/move_base.yaml has the values for this package's plugins.
struct StandaloneMoveBaseParameters {
  std::string base_global_planner = "lstm_planner/LstmGlobalPlanner";
  std::string base_local_planner = "lstm_planner/SteeringController";
  double planner_frequency = 0.0;
  double controller_frequency = 20.0;
  double planner_patience = 5.0;
  double controller_patience = 15.0;
  double oscillation_timeout = 0.0;
  double oscillation_distance = 0.5;
};

/// Visits every parameter but those of the plugins and the costmaps; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitStandaloneMoveBaseParameters(Parameters& node, const Visitor& visit) {
  visit("base_global_planner", node.base_global_planner, {}, "", "plugin that plans");
  visit("base_local_planner", node.base_local_planner, {}, "", "plugin that drives");
  visit("planner_frequency", node.planner_frequency, {0.0, 1000.0}, "Hz",
        "plans per second while there is a goal; 0: only one plan per goal, too few for LstmGlobalPlanner");
  visit("controller_frequency", node.controller_frequency, {0.1, 1000.0}, "Hz",
        "commands per second; lower lets the robot drive on longer when the scanner fails");
  visit("planner_patience", node.planner_patience, {0.0, 86400.0}, "s",
        "time without a plan after which the goal is given up; longer survives longer gaps of the scanner");
  visit("controller_patience", node.controller_patience, {0.0, 86400.0}, "s",
        "time without a safe command after which the goal is given up");
  visit("oscillation_timeout", node.oscillation_timeout, {0.0, 86400.0}, "s",
        "the goal is given up if the robot stays within oscillation_distance for this time; 0: never");
  visit("oscillation_distance", node.oscillation_distance, {0.001, 1000.0}, "m", "see oscillation_timeout");
}

}  // namespace lstm_planner
