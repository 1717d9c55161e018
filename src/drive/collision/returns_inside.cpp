#include "lstm_planner/drive/collision/returns_inside.hpp"

#include <cstddef>
#include <cstdio>

namespace lstm_planner {

std::string returnsInside(const std::vector<Point2>& returns, const Footprint& footprint) {
  constexpr double kNoise = 0.03;  // m
  std::size_t count = 0;
  double deepest = -kNoise;
  Point2 where;
  for (const Point2& point : returns) {
    const double distance = footprint.distanceTo(point);
    if (distance >= -kNoise) continue;
    ++count;
    if (distance > deepest) continue;
    deepest = distance;
    where = point;
  }
  if (count == 0) return "";
  char text[300];
  std::snprintf(
      text, sizeof(text),
      "returns of the scan are inside the footprint (%zu), the deepest %.2f m, at (%.2f, %.2f) m in the robot's "
      "frame: if it is a part of the robot, filter these beams (package laser_filters) or raise the "
      "scanner's range_min",
      count, -deepest, where.x, where.y);
  return text;
}

}  // namespace lstm_planner
