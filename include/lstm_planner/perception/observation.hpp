#pragma once

#include <array>

#include "lstm_planner/geometry.hpp"
#include "lstm_planner/perception/sectors.hpp"

namespace lstm_planner {

/// What the network is told at one step, in physical units. The planner, the recorder and the trainer share it.
struct Observation {
  std::array<double, kSectorCount> sector_ranges{};  ///< m, right to left, at most the range cap
  double goal_distance = 0.0;    ///< m
  double goal_bearing = 0.0;     ///< rad in (-pi, pi], positive to the left of the robot's heading
  double heading = 0.0;          ///< rad in (-pi, pi], absolute, in the odometry frame
  double previous_action = 0.0;  ///< rad, the steering angle of the last step; 0 at the first step
};

/// Composes an observation from the averages, the pose and the goal, both in the odometry frame. With a
/// `position_cell` > 0 (m) the robot's position is first rounded to the centre of a cell of that size (thesis 4.3.2).
Observation observe(const Sectors& sectors, const Pose2& pose, const Point2& goal, double previous_action,
                    double position_cell = 0.0);

/// Yaw of a quaternion, rad in (-pi, pi]. Not necessarily a unit quaternion; NaN when it is zero or not finite.
double yawOfQuaternion(double x, double y, double z, double w);

}  // namespace lstm_planner
