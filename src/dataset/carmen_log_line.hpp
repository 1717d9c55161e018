#pragma once

#include <string>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

/// A line ODOM, FLASER or ROBOTLASER1.
struct CarmenLine {
  double stamp = 0.0;  ///< s, ipc_timestamp
  Pose2 robot;         ///< odometry frame
  bool has_scan = false;
  LaserScan scan;  ///< without stamp
  Pose2 laser;     ///< odometry frame
};

/// Each reads what follows the line's first word. Throws std::invalid_argument saying what is wrong.
CarmenLine parseCarmenOdometry(const std::string& text);
CarmenLine parseCarmenFrontLaser(const std::string& text);
CarmenLine parseCarmenRobotLaser(const std::string& text);

}  // namespace lstm_planner
