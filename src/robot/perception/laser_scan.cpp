#include "lstm_planner/robot/perception/laser_scan.hpp"

#include <cmath>

#include "robot/perception/reading_bounds.hpp"
#include "robot/perception/scan_kernels.hpp"

namespace lstm_planner {

long RangeProfile::beamTowards(double towards) const {
  if (ranges.empty() || increment == 0.0) return -1;
  const double sense = increment < 0.0 ? -1.0 : 1.0;
  double turn = std::fmod(sense * (towards - first_direction), kFullTurn);
  if (turn < 0.0) turn += kFullTurn;
  const double step = std::abs(increment);
  const long beam = std::lround(turn / step);
  const long count = static_cast<long>(ranges.size());
  if (beam < count) return beam;
  // Just before the first beam is nearly a whole turn after it.
  return kFullTurn - turn < step ? 0 : (turn / step < static_cast<double>(count) ? count - 1 : -1);
}

void toProfile(const LaserScan& scan, const SensorMount& mount, const ScanRules& rules, RangeProfile* profile) {
  const double mirror = mount.upside_down ? -1.0 : 1.0;
  profile->origin = {mount.pose.x, mount.pose.y};
  profile->first_direction = mount.pose.yaw + mirror * scan.angle_min;
  profile->increment = mirror * scan.angle_increment;
  profile->nearest_range = scan.range_min;
  profile->farthest_range = scan.range_max;
  profile->ranges.resize(scan.ranges.size());
  scanKernels().meanings(readingBounds(scan, rules), scan.ranges.data(), scan.ranges.size(), profile->ranges.data());
}

void toPoints(const RangeProfile& profile, BeamDirections* directions, std::vector<Point2>* points) {
  const std::size_t beams = profile.ranges.size();
  directions->set(profile.first_direction, profile.increment, beams);
  points->resize(beams);
  if (beams == 0) return;
  points->resize(scanKernels().points(profile.ranges.data(), beams, profile.nearest_range, &profile.origin.x,
                                      &directions->data()->x, &points->front().x));
}

}  // namespace lstm_planner
