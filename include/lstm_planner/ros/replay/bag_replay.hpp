#pragma once

#include <string>
#include <type_traits>

#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "lstm_planner/ros/recorder/bag_drive.hpp"

namespace lstm_planner {

/// What `bag_replay` reads from its private namespace; launch/replay.launch has an argument for each.
struct BagReplayParameters {
  std::string bag;
  BagDriveOptions drive;
  GlobalPlannerParameters planner;  ///< ~LstmGlobalPlanner/...: as in move_base
  double rate = 1.0;
  double patience = 10.0;
  bool stay = false;
  std::string decisions;
};

/// Visits every parameter but `mount`, a pose, and those of the planner; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitBagReplayParameters(Parameters& replay, const Visitor& visit) {
  visit("bag", replay.bag, {}, "", "path of a recording with scan and odometry or tf");
  visit("scan_topic", replay.drive.scan_topic, {}, "", "sensor_msgs/LaserScan; empty: the only one in the bag");
  visit("odometry_topic", replay.drive.odometry_topic, {}, "", "nav_msgs/Odometry; empty: the bag's only one, or tf");
  std::string goal_topic = replay.drive.goal_topics.empty() ? "" : replay.drive.goal_topics.front();
  visit("goal_topic", goal_topic, {}, "", "empty: the same topics as the recorder");
  if constexpr (!std::is_const_v<Parameters>) {
    if (!goal_topic.empty()) replay.drive.goal_topics = {goal_topic};
  }
  visit("odometry_frame", replay.drive.odometry_frame, {}, "", "frame of the odometry, if it comes from tf");
  visit("base_frame", replay.drive.base_frame, {}, "", "the robot's frame, if the odometry does not name it");
  visit("hindsight", replay.drive.hindsight, {}, "", "the goals are places that the robot reached");
  visit("rate", replay.rate, {0.0, 1000.0}, "", "seconds of the recording per second; 0: as fast as possible");
  visit("patience", replay.patience, {0.0, 3600.0}, "s", "how long to wait for a subscriber, in the computer's time");
  visit("stay", replay.stay, {}, "", "waits for Ctrl-C at the end, so that rviz shows the last step");
  visit("decisions", replay.decisions, {}, "", "path of a CSV file for the decisions; empty: none");
}

}  // namespace lstm_planner
