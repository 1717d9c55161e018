#pragma once

#include <array>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/sectors.hpp"

namespace lstm_planner {

constexpr int kPlaceDirections = 8;
constexpr int kPlaceScales = 3;

/// Where the robot was of the places around it, in direction heading + i * 45 degrees.
struct PlacesAround {
  std::array<double, kPlaceDirections> visits{};  ///< times that it came in
  std::array<double, kPlaceDirections> ages{};    ///< steps since it was there last; means nothing without visits
};

/// The network's inputs at one step, in physical units. The planner, the recorder and the trainer share it.
struct Observation {
  std::array<double, kSectorCount> sector_ranges{};  ///< m, right to left, at most the range cap
  double goal_distance = 0.0;                        ///< m
  double goal_bearing = 0.0;                         ///< rad in (-pi, pi], positive to the left of the robot's heading
  double heading = 0.0;                              ///< rad in (-pi, pi], absolute, in the odometry frame
  double previous_action = 0.0;                      ///< rad, the steering angle of the last step; 0 at the first step

  // What the agent remembers; a network need not look at it.
  double route_bearing = 0.0;  ///< rad in (-pi, pi], relative to the heading: where the path through what is remembered
                               ///< starts; the goal's bearing where nothing is remembered
  double route_length = 0.0;   ///< m, of that path to the goal; the goal's distance where nothing is remembered
  std::array<double, kPlaceDirections> visits{};  ///< times that the robot was at the place a step away in direction
                                                  ///< heading + i * 45 degrees (PlaceTrace)
  /// The same for squares of 0.5, 1.5 and 4.5 m, 0.8, 2 and 5 m away, or as far as it seems to be free (DriveTrace).
  std::array<PlacesAround, kPlaceScales> places{};
  double room_visits = 0.0;       ///< times that the robot came into the square of 1.5 m that it is in
  double behind_best = 0.0;       ///< m, how much farther the goal is than it was at the nearest
  double steps_since_best = 0.0;  ///< steps since then
  Point2 motion;                  ///< m, to where the robot is now, in its frame of the step before
  double turn = 0.0;              ///< rad in (-pi, pi], since the step before
};

/// Composes an observation from the averages, the pose and the goal, both in the odometry frame, as of an agent that
/// remembers nothing. With a `position_cell` > 0 (m) the robot's position is first rounded to the centre of a cell of
/// that size (thesis 4.3.2).
Observation observe(const Sectors& sectors, const Pose2& pose, const Point2& goal, double previous_action,
                    double position_cell = 0.0);

/// What would be observed if right and left were exchanged.
Observation mirrored(Observation observation);

/// Yaw of a quaternion, rad in (-pi, pi]. Not necessarily a unit quaternion; NaN when it is zero or not finite.
double yawOfQuaternion(double x, double y, double z, double w);

}  // namespace lstm_planner
