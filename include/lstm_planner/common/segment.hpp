#pragma once

#include <algorithm>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// Squared distance from a point to a line segment, m^2.
inline double squaredDistanceToSegment(const Point2& point, const Point2& from, const Point2& to) {
  const Point2 line{to.x - from.x, to.y - from.y};
  const Point2 off{point.x - from.x, point.y - from.y};
  const double length = line.x * line.x + line.y * line.y;
  const double share = length > 0.0 ? std::clamp((off.x * line.x + off.y * line.y) / length, 0.0, 1.0) : 0.0;
  const double dx = off.x - share * line.x;
  const double dy = off.y - share * line.y;
  return dx * dx + dy * dy;
}

}  // namespace lstm_planner
