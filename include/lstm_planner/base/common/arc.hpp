#pragma once

#include "lstm_planner/base/common/geometry.hpp"

namespace lstm_planner {

/// The pose after an arc of that length (m, negative: backwards) on which the heading turns by `turn` (rad,
/// counter-clockwise). The yaw is not normalised.
inline Pose2 alongTurn(const Pose2& from, double length, double turn) {
  // The chord of the arc; its direction is the mean of the two headings.
  const double half_turn = 0.5 * turn;
  const double chord = std::abs(half_turn) > 1e-9 ? length * std::sin(half_turn) / half_turn : length;
  const Point2 end = pointAlong(from, from.yaw + half_turn, chord);
  return {end.x, end.y, from.yaw + turn};
}

/// The same by the curvature of the arc, 1/m, positive to the left.
inline Pose2 alongArc(const Pose2& from, double curvature, double length) {
  return alongTurn(from, length, curvature * length);
}

/// As odometry counts: the length (m) straight on in the mean of the headings before and after a turn (rad). The yaw is
/// normalised.
inline Pose2 alongMeanHeading(const Pose2& from, double length, double turn) {
  const Point2 end = pointAlong(from, from.yaw + 0.5 * turn, length);
  return {end.x, end.y, normalizeAngle(from.yaw + turn)};
}

}  // namespace lstm_planner
