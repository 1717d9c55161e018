#pragma once

#include <ros/node_handle.h>

#include <ctime>
#include <string>
#include <vector>

#include "lstm_planner/base/common/geometry.hpp"
#include "lstm_planner/robot/dataset/recorder_parameters.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"

namespace lstm_planner {

/// Parameters of the node dataset_recorder; config/dataset_recorder.yaml explains each.
struct RecorderNodeParameters {
  struct WayPoint {
    std::string name;
    Pose2 pose;
  };

  std::string output = "~/lstm_planner_%Y-%m-%dT%H-%M-%SZ.sqlite";  ///< see outputPath()
  std::string scan_topic = "scan";
  std::string odom_topic = "odom";
  std::string base_frame = "base_footprint";  ///< where the odometry does not name it
  std::vector<WayPoint> way_points;           ///< none: goals come from elsewhere only
  std::string way_point_frame = "odom";
  int seed = 1;             ///< of the order of the way-points
  double disk_low = 500.0;  ///< MB; with less than this left on the disk a warning is given
  RecorderParameters recorder;
};

/// Reads the namespace of `node_handle`, warns of parameters there that are not known, and throws std::invalid_argument
/// naming the parameter, its value and what was expected.
RecorderNodeParameters loadRecorderNodeParameters(const ros::NodeHandle& node_handle);

/// What it does before it checks: read every parameter into its variable. Throws std::invalid_argument for those of
/// another type.
void readParameters(ParameterReader* reader, RecorderNodeParameters* parameters);

/// The file that `output` means at a time: ~/ is the user's home, package://NAME/ a package's folder, and %Y and the
/// like are replaced as by strftime, in UTC. Throws std::invalid_argument when that is none.
std::string outputPath(const std::string& output, std::time_t now);

}  // namespace lstm_planner
