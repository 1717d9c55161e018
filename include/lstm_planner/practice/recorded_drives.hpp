#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/dataset/drive_step.hpp"
#include "lstm_planner/dataset/recorder_parameters.hpp"
#include "lstm_planner/simulation/scripted_driver.hpp"
#include "lstm_planner/simulation/simulated_robot.hpp"
#include "lstm_planner/simulation/world.hpp"

namespace lstm_planner {

/// Random places of a building for a robot to drive to (world frame): free, with room for a disc of that radius (m),
/// each reachable from all others, and at least `spacing` (m) apart if the building has so many such places. The same
/// for the same seed. Throws std::invalid_argument if there are fewer than `count` places, or none.
std::vector<Point2> drawWaypoints(const GridWorld& world, int count, double radius, double spacing, std::uint64_t seed);

/// How drives are simulated and recorded.
struct RecordedDrivesParameters {
  SimulatedRobot::Parameters robot;
  ScriptedDriverParameters driver;
  RecorderParameters recorder;
  long steps = 1000;  ///< labelled steps to record; 0: no limit
  long goals = 0;     ///< goals to drive to; 0: no limit. At least one of the two is needed
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const RecordedDrivesParameters& parameters);

/// Result of the drives.
struct RecordedDrives {
  long steps = 0;
  long goals = 0;    ///< goals that were given
  long reached = 0;  ///< of these, those that were reached
  long no_path = 0;  ///< of these, those without a path
  int contacts = 0;
  double time = 0.0;         ///< s, simulated
  double path_length = 0.0;  ///< m, truly driven
};

/// A ScriptedDriver drives a simulated robot to waypoints (world frame), one after the other in random order (thesis
/// 4.2), and a DriveRecorder records it. The goals are given in the frame "map"; the pose of this frame in the odometry
/// frame is known without error, as from a perfect localisation. The robot starts at the first waypoint, in a random
/// direction. Steps go to `sink`, and the recording is finished. The same for the same seed. Throws as validate(), and
/// std::invalid_argument for fewer than two waypoints, or if there is no path between any of them.
RecordedDrives recordDrives(const GridWorld& world, const std::vector<Point2>& waypoints,
                            const RecordedDrivesParameters& parameters, std::uint64_t seed, StepSink* sink);

}  // namespace lstm_planner
