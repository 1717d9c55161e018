#pragma once

#include <ros/node_handle.h>

#include <ctime>
#include <string>
#include <vector>

#include "lstm_planner/dataset/recorder_parameters.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"

namespace lstm_planner {

/// Parameters of the node dataset_recorder; config/dataset_recorder.yaml explains each.
struct RecorderNodeParameters {
  std::string output = "~/lstm_planner{namespace}_%Y-%m-%dT%H-%M-%SZ.sqlite";
  std::string scan_topic = "scan";
  std::string odom_topic = "odom";
  std::string base_frame = "base_footprint";
  std::vector<NamedPose> waypoints;
  std::string waypoint_frame = "odom";
  int seed = 1;
  double disk_low = 500.0;
  RecorderParameters recorder;
};

/// Visits every parameter; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitRecorderNodeParameters(Parameters& node, const Visitor& visit) {
  visit("output", node.output, {}, "",
        "path of the file; may start with ~/ or package://NAME/; %Y and the like are replaced by the time, {namespace} "
        "by _ and the node's namespace, if it has one");
  visit("scan_topic", node.scan_topic, {}, "", "sensor_msgs/LaserScan");
  visit("odom_topic", node.odom_topic, {}, "", "nav_msgs/Odometry");
  visit("base_frame", node.base_frame, {}, "", "the robot's frame, if the odometry does not name it");
  visit("disk_low", node.disk_low, {0.0, 1e9}, "MB", "a warning is given if less than this is free on the disk");
  visit("waypoints", node.waypoints, {}, "m", "the goals, in random order; none: goals come only from topics");
  visit("waypoint_frame", node.waypoint_frame, {}, "", "the frame of the waypoints");
  visit("seed", node.seed, {}, "", "of the order of the waypoints");
  visitRecorderParameters(node.recorder, visit);
}

/// Reads the namespace of `node_handle`, then what a robot's file there (config/robots) has in its group
/// LstmGlobalPlanner under the same names, which counts. Warns of parameters that are not known, and throws
/// std::invalid_argument naming the parameter, its value and what was expected.
RecorderNodeParameters loadRecorderNodeParameters(const ros::NodeHandle& node_handle);

/// The file that `output` means at a time: ~/ is the user's home, package://NAME/ a package's folder, %Y and the like
/// are replaced as by strftime, in UTC, and {namespace} by that of the node (for /robot1 "_robot1"). Throws
/// std::invalid_argument when that is none.
std::string outputPath(const std::string& output, std::time_t now);

}  // namespace lstm_planner
