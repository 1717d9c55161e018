#pragma once

#include "lstm_planner/common/footprint.hpp"
#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "lstm_planner/simulation/create2.hpp"

namespace lstm_planner::test {

/// A controller that is told all that a base can do, and drives at most at `max_linear` (m/s).
inline MotionParameters limitsOf(const Create2Parameters& base, double max_linear) {
  MotionParameters limits;
  limits.max_linear = max_linear;
  limits.max_wheel_speed = base.max_wheel_speed;
  limits.axle_length = base.axle_length;
  limits.linear_acceleration = base.max_wheel_acceleration;
  return limits;
}

inline const Footprint& jackal() {
  static const Footprint footprint({{0.254, 0.215}, {0.254, -0.215}, {-0.254, -0.215}, {-0.254, 0.215}});
  return footprint;
}

/// Its axle is in front of its middle.
inline const Footprint& waffle() {
  static const Footprint footprint({{-0.205, -0.145}, {-0.205, 0.145}, {0.077, 0.145}, {0.077, -0.145}});
  return footprint;
}

inline MotionParameters limitsOfJackal() {
  Create2Parameters base;
  base.max_wheel_speed = 2.4;
  base.axle_length = 0.376;
  base.max_wheel_acceleration = 2.0;
  return limitsOf(base, 2.0);
}

}  // namespace lstm_planner::test
