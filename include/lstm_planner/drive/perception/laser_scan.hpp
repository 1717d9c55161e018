#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/beam_directions.hpp"
#include "lstm_planner/drive/perception/scan_rules.hpp"

namespace lstm_planner {

/// One sweep of a planar laser scanner; the fields of sensor_msgs/LaserScan that matter, without ROS.
/// Angles in rad in the sensor's frame, ranges in m, the stamp in s. When each beam was measured: BeamTimes.
struct LaserScan {
  double stamp = 0.0;
  double angle_min = 0.0;
  double angle_increment = 0.0;  ///< may be negative
  double range_min = 0.0;
  double range_max = 0.0;
  std::vector<float> ranges;
};

/// How the scanner sits on the robot: its position and yaw in the base frame, and whether it hangs upside down, which
/// mirrors the order of the beams.
struct SensorMount {
  Pose2 pose;
  bool upside_down = false;

  /// Of angles: from the sensor's frame to the base frame.
  double mirror() const { return upside_down ? -1.0 : 1.0; }
};

/// The ranges of a scan by direction, in the base frame: what lies between the scanner and a range was seen to be free.
struct RangeProfile {
  Point2 origin;                 ///< where the scanner is, m
  double first_direction = 0.0;  ///< rad, of ranges[0]
  double increment = 0.0;        ///< rad from one range to the next; may be negative
  /// m, > 0: a return. +inf: nothing there. 0: not measured. -inf: something nearer than `nearest_range`. kSilent: the
  /// driver's reading for no return, where it may also mean that nothing could be measured (NaN, 0), or that a filter
  /// took the beam out (beyond range_max): counts as nothing there for the network, but shows no place to be free.
  std::vector<float> ranges;
  double nearest_range = 0.0;  ///< m, below which the scanner cannot measure
  long too_near = 0;           ///< readings above 0 and below `nearest_range`: of the ranges that are not measured
  /// m, beyond which it cannot: there is nothing up to here where the range is +inf.
  double farthest_range = std::numeric_limits<double>::infinity();

  static constexpr float kSilent = -1.0f;

  /// `farthest_range` as a float, at most the largest one.
  float farthestRange() const {
    return static_cast<float>(std::min<double>(farthest_range, std::numeric_limits<float>::max()));
  }
  double direction(std::size_t beam) const { return first_direction + static_cast<double>(beam) * increment; }
  /// True for a return with a range.
  bool isMeasured(std::size_t beam) const { return ranges[beam] > 0.0f && std::isfinite(ranges[beam]); }
  /// Index of the beam nearest to `direction` (rad, base frame); -1 when none is within an increment of it,
  /// unless the scan closes.
  long beamTowards(double direction) const;
  /// Whether the last beam is beside the first one, or one is missing between them: some drivers divide the span of the
  /// readings that they got by their number.
  bool closes() const { return (static_cast<double>(ranges.size()) + 1.5) * std::abs(increment) > kFullTurn; }
  /// Index of a beam that was counted from another one, maybe beyond the ends: where the scan closes it goes on there.
  /// -1 when there is none.
  long beamAt(long counted) const;
  /// Whether `direction` (rad, base frame) lies between the first and the last beam. All do if the scan closes.
  bool isInView(double direction) const;

 private:
  double turnTo(double direction) const;
};

/// Fills a profile from a scan; its memory is reused.
void toProfile(const LaserScan& scan, const SensorMount& mount, const ScanRules& rules, RangeProfile* profile);

/// Adds the measured returns as points in the base frame, m, in the order of the beams; what is too near to be measured
/// is taken to be at the nearest range. The directions of the beams are kept from one scan to the next, which makes it
/// ten times as fast.
void addPoints(const RangeProfile& profile, BeamDirections* directions, std::vector<Point2>* points);

}  // namespace lstm_planner
