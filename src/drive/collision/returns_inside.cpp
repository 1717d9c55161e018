#include "lstm_planner/drive/collision/returns_inside.hpp"

#include <cstddef>

#include "lstm_planner/common/text_table.hpp"

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
  return "returns of the scan are inside the footprint (" + std::to_string(count) + "), the deepest " +
         fixedText(-deepest, 2) + " m, at (" + fixedText(where.x, 2) + ", " + fixedText(where.y, 2) +
         ") m in the robot's frame: if it is a part of the robot, filter these beams (package laser_filters) or raise "
         "the scanner's range_min";
}

}  // namespace lstm_planner
