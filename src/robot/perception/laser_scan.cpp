#include "lstm_planner/robot/perception/laser_scan.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "robot/perception/baseline_vectors.hpp"
#include "robot/perception/reading_bounds.hpp"

namespace lstm_planner {

namespace {

/// A vector of ranges.
bool allPositiveAndFinite(const float* ranges) {
  const Floats some = loadFloats(ranges);
  return !any(~((some > Floats{}) & (some < allOf(std::numeric_limits<float>::infinity()))));
}

bool isPositiveAndFinite(float value) {
  constexpr std::uint32_t kInfinity = 0x7f800000;
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits - 1 < kInfinity - 1;
}

}  // namespace

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

void toProfile(const LaserScan& scan, const SensorMount& mount, const ScanRules& rules, RangeProfile* profile) {
  const double mirror = mount.upside_down ? -1.0 : 1.0;
  profile->origin = {mount.pose.x, mount.pose.y};
  profile->first_direction = mount.pose.yaw + mirror * scan.angle_min;
  profile->increment = mirror * scan.angle_increment;
  profile->nearest_range = scan.range_min;
  profile->farthest_range = scan.range_max;
  profile->ranges.resize(scan.ranges.size());
  const ReadingBounds bounds(scan, rules);
  const std::size_t beams = scan.ranges.size();
  const float* const readings = scan.ranges.data();
  float* const ranges = profile->ranges.data();
  std::size_t i = 0;
  for (; i + kLanes <= beams; i += kLanes) store(bounds.meaning(loadFloats(readings + i)), ranges + i);
  for (; i < beams; ++i) ranges[i] = bounds.meaning(allOf(readings[i]))[0];
}

void toPoints(const RangeProfile& profile, BeamDirections* directions, std::vector<Point2>* points) {
  constexpr float kTooNear = -std::numeric_limits<float>::infinity();
  const std::size_t beams = profile.ranges.size();
  directions->set(profile.first_direction, profile.increment, beams);
  points->resize(beams);
  const float* const ranges = profile.ranges.data();
  const Point2* const units = directions->data();
  Point2* const out = points->data();
  const Point2 origin = profile.origin;
  std::size_t count = 0;
  const auto add = [&](std::size_t beam, double range, std::size_t to) {
    out[to] = {origin.x + range * units[beam].x, origin.y + range * units[beam].y};
  };
  for (std::size_t i = 0; i < beams;) {
    // Returns lie side by side. Where the place of each depends on the one before, the processor waits.
    if (i + kLanes <= beams && allPositiveAndFinite(ranges + i)) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) add(i + lane, ranges[i + lane], count + lane);
      count += kLanes;
      i += kLanes;
      continue;
    }
    // Written in any case, and overwritten by the next: faster than a jump that nobody can foresee.
    const bool too_near = ranges[i] == kTooNear;
    add(i, too_near ? profile.nearest_range : ranges[i], count);
    count += isPositiveAndFinite(ranges[i]) || too_near ? 1 : 0;
    ++i;
  }
  points->resize(count);
}

}  // namespace lstm_planner
