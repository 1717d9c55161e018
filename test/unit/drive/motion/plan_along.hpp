#pragma once

#include <vector>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner::test {

/// Poses 5 cm apart along straight lines.
inline std::vector<Pose2> planAlong(const std::vector<Point2>& corners, double last_yaw = 0.0) {
  std::vector<Pose2> plan = {{corners[0].x, corners[0].y, 0.0}};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double length = distanceBetween(corners[i - 1], corners[i]);
    const double direction = directionTo(corners[i - 1], corners[i]);
    for (double along = 0.05; along < length + 0.01; along += 0.05) {
      const Point2 point = pointAlong(corners[i - 1], direction, along);
      plan.push_back({point.x, point.y, direction});
    }
  }
  plan.back().yaw = last_yaw;
  return plan;
}

}  // namespace lstm_planner::test
