#include "lstm_planner/perception/laser_scan.hpp"

#include <cmath>

namespace lstm_planner {

bool isMeasuredRange(float range, const LaserScan& scan, const ScanLimits& limits) {
  if (!std::isfinite(range) || range <= 0.0f) return false;
  // Messages carry the limits as floats: a reading that equals its limit must not fall out by the rounding of a double.
  if (range < static_cast<float>(scan.range_min) || range > static_cast<float>(scan.range_max)) return false;
  return std::abs(range - limits.no_return_reading) > limits.no_return_tolerance;
}

void toPoints(const LaserScan& scan, const SensorMount& mount, const ScanLimits& limits, std::vector<Point2>* points) {
  points->clear();
  const double mirror = mount.upside_down ? -1.0 : 1.0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const float range = scan.ranges[i];
    if (!isMeasuredRange(range, scan, limits)) continue;
    const double angle = mirror * (scan.angle_min + static_cast<double>(i) * scan.angle_increment);
    points->push_back(toParentFrame(mount.pose, {range * std::cos(angle), range * std::sin(angle)}));
  }
}

}  // namespace lstm_planner
