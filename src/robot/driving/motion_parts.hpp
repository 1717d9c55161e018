#pragma once

#include <algorithm>
#include <vector>

#include "lstm_planner/robot/driving/motion_controller.hpp"

namespace lstm_planner {

/// m/s that the robot may be faster than it measures: encoders count whole ticks.
constexpr double kSpeedError = 0.02;

inline double clampMagnitude(double value, double limit) { return std::max(-limit, std::min(limit, value)); }

/// What moves, and what has moved and stands.
struct MotionController::Persons {
  Persons(const Footprint& footprint, double reach, const std::vector<Point2>& moving_points,
          const std::vector<Point2>& resting_points)
      : moving(footprint, 0.0, reach),
        resting(footprint, 0.0, reach),
        near(!moving_points.empty() || !resting_points.empty()) {
    moving.show(moving_points);
    resting.show(resting_points);
  }
  Shield moving;
  Shield resting;
  bool near;  ///< there is somebody
};

/// What a robot with corners has to know of the moment.
struct MotionController::Moment {
  const Shield& shield;
  const Persons& persons;
  Twist2 current;
  double period;  ///< s
  const MotionHistory& history;
};

}  // namespace lstm_planner
