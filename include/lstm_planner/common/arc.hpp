#pragma once

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// The pose after an arc. `length`: of the arc, m, negative for backwards. `turn`: how far the heading turns on it,
/// rad, counter-clockwise. The yaw of the result is not normalised.
inline Pose2 alongTurn(const Pose2& from, double length, double turn) {
  // The chord of the arc; its direction is the mean of the two headings.
  const double half_turn = 0.5 * turn;
  const double chord = std::abs(half_turn) > 1e-9 ? length * std::sin(half_turn) / half_turn : length;
  const Point2 end = pointAlong(from, from.yaw + half_turn, chord);
  return {end.x, end.y, from.yaw + turn};
}

/// The pose after an arc with the given curvature, 1/m, positive to the left. Otherwise as alongTurn().
inline Pose2 alongArc(const Pose2& from, double curvature, double length) {
  return alongTurn(from, length, curvature * length);
}

/// The pose after a motion as odometry integrates it: straight on by `length` (m) in the mean of the headings before
/// and after the turn by `turn` (rad). The yaw of the result is normalised.
inline Pose2 alongMeanHeading(const Pose2& from, double length, double turn) {
  const Point2 end = pointAlong(from, from.yaw + 0.5 * turn, length);
  return {end.x, end.y, normalizeAngle(from.yaw + turn)};
}

}  // namespace lstm_planner
