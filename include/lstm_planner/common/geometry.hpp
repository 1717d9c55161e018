#pragma once

#include <cmath>
#include <vector>

namespace lstm_planner {

/// A point or a vector of the plane, m.
struct Point2 {
  double x = 0.0;
  double y = 0.0;
};

/// A planar pose: m, m, rad. The yaw is counter-clockwise from the x axis (REP 103) and need not be normalised.
struct Pose2 {
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
};

/// Velocity in the base frame: m/s forward, rad/s counter-clockwise.
struct Twist2 {
  double linear = 0.0;
  double angular = 0.0;
};

inline double square(double value) { return value * value; }

constexpr double kFullTurn = 2.0 * M_PI;  ///< rad

/// The angle normalised to (-pi, pi], rad; NaN if the angle is not finite.
inline double normalizeAngle(double angle) {
  if (angle > -M_PI && angle <= M_PI) return angle;  // nearly always, and the remainder is slow
  const double wrapped = std::remainder(angle, kFullTurn);
  return wrapped <= -M_PI ? wrapped + kFullTurn : wrapped;
}

inline double degreesToRadians(double degrees) { return degrees * M_PI / 180.0; }

/// Euclidean distance of the positions, m.
template <typename A, typename B>
double distanceBetween(const A& a, const B& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

/// Angle between the headings, rad, in [0, pi].
inline double turnBetween(const Pose2& a, const Pose2& b) { return std::abs(normalizeAngle(b.yaw - a.yaw)); }

/// Direction from a to b in the frame both are given in, rad; 0 when the two coincide.
template <typename A, typename B>
double directionTo(const A& a, const B& b) {
  return std::atan2(b.y - a.y, b.x - a.x);
}

/// The point at `distance` m from `from` in `direction` (rad, in the frame of `from`).
template <typename A>
Point2 pointAlong(const A& from, double direction, double distance) {
  return {from.x + distance * std::cos(direction), from.y + distance * std::sin(direction)};
}

/// Transforms a point from the frame of `pose` to the frame in which `pose` is given.
inline Point2 toParentFrame(const Pose2& pose, const Point2& point) {
  const double c = std::cos(pose.yaw);
  const double s = std::sin(pose.yaw);
  return {pose.x + c * point.x - s * point.y, pose.y + s * point.x + c * point.y};
}

/// The same for several points.
inline std::vector<Point2> toParentFrame(const Pose2& pose, std::vector<Point2> points) {
  for (Point2& point : points) point = toParentFrame(pose, point);
  return points;
}

/// Transforms a point from the frame in which `pose` is given to the frame of `pose`.
inline Point2 toLocalFrame(const Pose2& pose, const Point2& point) {
  const double c = std::cos(pose.yaw);
  const double s = std::sin(pose.yaw);
  const double dx = point.x - pose.x;
  const double dy = point.y - pose.y;
  return {c * dx + s * dy, -s * dx + c * dy};
}

/// Transforms the pose `child` from the frame of `parent` to the frame in which `parent` is given.
inline Pose2 compose(const Pose2& parent, const Pose2& child) {
  const Point2 position = toParentFrame(parent, {child.x, child.y});
  return {position.x, position.y, normalizeAngle(parent.yaw + child.yaw)};
}

/// The inverse transform: the frame in which `pose` is given, as a pose in the frame of `pose`.
inline Pose2 inverse(const Pose2& pose) {
  const Point2 origin = toLocalFrame(pose, {0.0, 0.0});
  return {origin.x, origin.y, normalizeAngle(-pose.yaw)};
}

inline bool isFinite(const Pose2& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.yaw);
}

}  // namespace lstm_planner
