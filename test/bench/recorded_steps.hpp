#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"
#include "lstm_planner/simulation/drive.hpp"

namespace lstm_planner {

/// What the planner is given each time it is asked.
struct RecordedStep {
  LaserScan scan;
  Pose2 pose;         ///< base in the odometry frame
  double time = 0.0;  ///< s
};

/// A drive in the simulation, as a planner in a robot would have seen it.
struct RecordedDrive {
  std::string world;
  SensorMount mount;
  Pose2 goal;  ///< odometry frame
  std::vector<RecordedStep> steps;
};

/// The policy that the package ships for the Create 2.
DrivePolicy shippedPolicy();

/// A drive of the shipped policy with a Hokuyo of 1081 beams, ten scans a second, noise, slip and latency as in
/// `lstm_planner drive`, for at most `longest` (s). `seed`: of the noise.
RecordedDrive recordDrive(const std::string& name, const World& world, const DriveTask& task, double longest,
                          std::uint64_t seed);

/// Such drives through an office with furniture, a maze and the demo's building, always the same three; starts, goals
/// and noise are drawn from the seed.
std::vector<RecordedDrive> recordDrives(std::uint64_t seed);

/// Those of seed 1, driven when they are asked for first.
const std::vector<RecordedDrive>& recordedDrives();

}  // namespace lstm_planner
