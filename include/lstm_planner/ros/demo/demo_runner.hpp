#pragma once

#include <string>
#include <vector>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// What `demo_runner` reads from its private namespace. The scenario (parameters below `~scenario/`) is a goals file
/// such as config/demo_goals.yaml, which explains them.
struct DemoParameters {
  /// One of the goals that are driven to in turn.
  struct Goal {
    std::string name;
    Pose2 pose;         ///< in the map frame
    double time_limit;  ///< s
  };
  std::vector<Goal> goals;  ///< ~scenario/goals
  Pose2 start;              ///< ~start, else ~scenario/start: where odometry started, in the map frame
  std::string map;
  double free_threshold = -1.0;
  std::string odom_frame = "odom";
  std::string action = "move_base";
  double robot_radius = 0.17425;
  double arrival_radius = 0.4;
  double patience = 60.0;
  std::string picture;
  std::string result;
};

/// Visits every parameter but the scenario's; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitDemoParameters(Parameters& demo, const Visitor& visit) {
  visit("map", demo.map, {}, "", "path of the map_server yaml");
  visit("free_threshold", demo.free_threshold, {-1.0, 1.0}, "", "replaces the map's free_thresh if it is not negative");
  visit("odom_frame", demo.odom_frame, {}, "", "frame in which the goals are sent");
  visit("action", demo.action, {}, "", "name of the action server");
  visit("robot_radius", demo.robot_radius, {0.02, 5.0}, "m", "radius of the footprint, to compute the shortest paths");
  visit("arrival_radius", demo.arrival_radius, {0.01, 100.0}, "m",
        "largest distance between true position and goal at an arrival");
  visit("patience", demo.patience, {0.1, 86400.0}, "s",
        "longest wait for action server or ground truth, in the computer's time");
  visit("picture", demo.picture, {}, "", "path of the picture; empty: none");
  visit("result", demo.result, {}, "", "path of the result file; empty: none");
}

}  // namespace lstm_planner
