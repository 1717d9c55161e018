#pragma once

#include <string>
#include <variant>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/dataset/drive_step.hpp"
#include "lstm_planner/drive/decision/goal_tracker.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

// What a recorder hears of a drive, whether it happens now or was recorded by something else. Stamps in s.

/// A measurement of the odometry.
struct OdometryHeard {
  double stamp = 0.0;
  Pose2 pose;  ///< base in the odometry frame
  Twist2 twist;
};

/// A scan, and where its scanner is.
struct ScanHeard {
  double stamp = 0.0;
  LaserScan scan;
  SensorMount mount;
  std::string frame;
};

/// A goal to drive to.
struct GoalHeard {
  double stamp = 0.0;
  GoalInFrame goal;
  std::string source;  ///< Episode::goal_source
};

/// The goal is not driven to any more.
struct GoalGivenUp {
  double stamp = 0.0;
};

using DriveEvent = std::variant<OdometryHeard, GoalGivenUp, GoalHeard, ScanHeard>;

inline double stampOf(const DriveEvent& event) {
  return std::visit([](const auto& heard) { return heard.stamp; }, event);
}

/// Why nobody can work on an event, whoever heard it: a number that is not finite or larger than any measurement, a
/// scan of too many beams, a frame with too long a name. Empty when nothing is wrong.
std::string flawOf(const DriveEvent& event);

}  // namespace lstm_planner
