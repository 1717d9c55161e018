#include "lstm_planner/perception/laser_scan.hpp"

#include <cmath>
#include <limits>

namespace lstm_planner {

bool isMeasuredRange(float range, const LaserScan& scan, const ScanLimits& limits) {
  if (!std::isfinite(range) || range <= 0.0f) return false;
  // Messages carry the limits as floats: a reading that equals its limit must not fall out by the rounding of a double.
  if (range < static_cast<float>(scan.range_min) || range > static_cast<float>(scan.range_max)) return false;
  return std::abs(range - limits.no_return_reading) > limits.no_return_tolerance;
}

long RangeProfile::beamTowards(double towards) const {
  constexpr double kTurn = 2.0 * M_PI;
  if (ranges.empty() || increment == 0.0) return -1;
  const double sense = increment < 0.0 ? -1.0 : 1.0;
  double turn = std::fmod(sense * (towards - first_direction), kTurn);
  if (turn < 0.0) turn += kTurn;
  const double step = std::abs(increment);
  const long beam = std::lround(turn / step);
  const long count = static_cast<long>(ranges.size());
  if (beam < count) return beam;
  // Just before the first beam is nearly a whole turn after it.
  return kTurn - turn < step ? 0 : (turn / step < static_cast<double>(count) ? count - 1 : -1);
}

void toProfile(const LaserScan& scan, const SensorMount& mount, const ScanLimits& limits, RangeProfile* profile) {
  const double mirror = mount.upside_down ? -1.0 : 1.0;
  profile->origin = {mount.pose.x, mount.pose.y};
  profile->first_direction = mount.pose.yaw + mirror * scan.angle_min;
  profile->increment = mirror * scan.angle_increment;
  profile->ranges.resize(scan.ranges.size());
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const float range = scan.ranges[i];
    const bool nothing = range > static_cast<float>(scan.range_max) ||
                         std::abs(range - limits.no_return_reading) <= limits.no_return_tolerance;
    profile->ranges[i] = isMeasuredRange(range, scan, limits) ? range
                         : nothing                            ? std::numeric_limits<float>::infinity()
                                                              : 0.0f;
  }
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
