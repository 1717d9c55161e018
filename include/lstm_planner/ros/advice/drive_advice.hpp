#pragma once

#include <string>

#include "lstm_planner/ros/common/plugin_parameters.hpp"

namespace lstm_planner {

/// What `drive_advice` reads from its private namespace; launch/advice.launch has an argument for each.
struct DriveAdviceParameters {
  GlobalPlannerParameters planner;  ///< ~LstmGlobalPlanner/...: as in move_base
  std::string base_frame = "base_footprint";
  std::string goal_topic = "dataset_recorder/goal";
  double delay = 0.1;
  std::string decisions;
};

/// Visits every parameter but those of the planner; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitDriveAdviceParameters(Parameters& advice, const Visitor& visit) {
  visit("base_frame", advice.base_frame, {}, "", "the robot's frame, if the odometry does not name it");
  visit("goal_topic", advice.goal_topic, {}, "",
        "geometry_msgs/PoseStamped, in addition to move_base_simple/goal and move_base/goal");
  visit("delay", advice.delay, {0.0, 10.0}, "s",
        "how long to wait for late messages before messages with later stamps are processed");
  visit("decisions", advice.decisions, {}, "", "path of a CSV file for the decisions, written at the end; empty: none");
}

}  // namespace lstm_planner
