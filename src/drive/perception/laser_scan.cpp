#include "lstm_planner/drive/perception/laser_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lstm_planner {

namespace {

// Of the angle between two beams: places are computed from ranges in single precision.
constexpr double kRounding = 1e-3;

constexpr float kNothingThere = std::numeric_limits<float>::infinity();
constexpr double kCodeTolerance = 0.02;  // m

float toFloat(double range) { return static_cast<float>(std::min<double>(range, std::numeric_limits<float>::max())); }

/// What a reading means, as RangeProfile::ranges. Measured is what is positive, from `least` to `most` (m) and no code
/// for no return.
float meaningOf(float reading, float least, float most, const ScanRules& rules) {
  const bool is_code = rules.no_return_code != 0.0 && std::abs(reading - rules.no_return_code) <= kCodeTolerance;
  if (reading == kNothingThere || is_code) return kNothingThere;
  if ((reading >= least && reading <= most) || reading == -kNothingThere) return reading;
  const bool is_silent =
      (rules.nan_is_no_return && std::isnan(reading)) || (rules.zero_is_no_return && reading == 0.0f) ||
      (rules.beyond_is_no_return && reading > most) || (rules.below_is_no_return && reading > 0.0f && reading < least);
  return is_silent ? RangeProfile::kSilent : 0.0f;
}

}  // namespace

/// rad in [0, 2 pi) from the first beam, in the sense in which the beams follow each other.
double RangeProfile::turnTo(double towards) const {
  const double sense = increment < 0.0 ? -1.0 : 1.0;
  const double turn = std::fmod(sense * (towards - first_direction), kFullTurn);
  return turn < 0.0 ? turn + kFullTurn : turn;
}

long RangeProfile::beamTowards(double towards) const {
  if (ranges.empty() || increment == 0.0) return -1;
  const double turn = turnTo(towards);
  const double step = std::abs(increment);
  const long beam = std::lround(turn / step);
  const long count = static_cast<long>(ranges.size());
  if (beam < count) return beam;
  // Just before the first beam is nearly a whole turn after it.
  if (closes()) return kFullTurn - turn < turn - static_cast<double>(count - 1) * step ? 0 : count - 1;
  return kFullTurn - turn < step ? 0 : (turn / step < static_cast<double>(count) ? count - 1 : -1);
}

long RangeProfile::beamAt(long counted) const {
  const long count = static_cast<long>(ranges.size());
  if (counted >= 0 && counted < count) return counted;
  return count > 0 && closes() ? (counted % count + count) % count : -1;
}

bool RangeProfile::isInView(double towards) const {
  if (ranges.empty() || increment == 0.0) return false;
  const double step = std::abs(increment);
  const double width = step * static_cast<double>(ranges.size() - 1);
  const double turn = turnTo(towards);
  const double rounding = kRounding * step;
  return closes() || turn <= width + rounding || turn >= kFullTurn - rounding;
}

void toProfile(const LaserScan& scan, const SensorMount& mount, const ScanRules& rules, RangeProfile* profile) {
  const double mirror = mount.mirror();
  profile->origin = {mount.pose.x, mount.pose.y};
  profile->first_direction = mount.pose.yaw + mirror * scan.angle_min;
  profile->increment = mirror * scan.angle_increment;
  profile->nearest_range = scan.range_min;
  profile->farthest_range = scan.range_max;
  profile->ranges.resize(scan.ranges.size());
  const float least = std::max(std::numeric_limits<float>::denorm_min(), toFloat(scan.range_min));
  const float most = std::min(std::numeric_limits<float>::max(), toFloat(scan.range_max));
  std::transform(scan.ranges.begin(), scan.ranges.end(), profile->ranges.begin(),
                 [&](float reading) { return meaningOf(reading, least, most, rules); });
  profile->too_near = std::count_if(scan.ranges.begin(), scan.ranges.end(), [&](float reading) {
    return reading > 0.0f && reading < least && meaningOf(reading, least, most, rules) == 0.0f;
  });
}

void addPoints(const RangeProfile& profile, BeamDirections* directions, std::vector<Point2>* points) {
  const std::size_t beams = profile.ranges.size();
  directions->set(profile.first_direction, profile.increment, beams);
  points->reserve(points->size() + beams);
  for (std::size_t i = 0; i < beams; ++i) {
    const float reading = profile.ranges[i];
    const bool is_too_near = reading == -std::numeric_limits<float>::infinity();
    if (!is_too_near && !profile.isMeasured(i)) continue;
    const double range = is_too_near ? profile.nearest_range : reading;
    const Point2& direction = (*directions)[i];
    points->push_back({profile.origin.x + range * direction.x, profile.origin.y + range * direction.y});
  }
}

}  // namespace lstm_planner
