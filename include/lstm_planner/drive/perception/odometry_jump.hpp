#pragma once

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// Whether a robot of at most `max_speed` (m/s) cannot have driven from one pose to the other in `elapsed` s, 0 or
/// more. More than a second counts as one: a robot that hears no odometry for so long is stopped.
bool isOdometryJump(const Pose2& from, const Pose2& to, double elapsed, double max_speed);

}  // namespace lstm_planner
