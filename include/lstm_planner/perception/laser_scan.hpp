#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "lstm_planner/geometry.hpp"
#include "lstm_planner/perception/beam_directions.hpp"

namespace lstm_planner {

/// One sweep of a planar laser scanner; the fields of sensor_msgs/LaserScan that matter, without ROS.
/// Angles in rad in the sensor's frame, ranges in m, the stamp in s is that of the first beam.
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
};

/// What is expected of a scan, and which readings mean "nothing there".
struct ScanLimits {
  /// Readings this close to `no_return_reading` are no returns although they look like ranges (16 bit counters at
  /// their end, e.g. 65.53 m).
  double no_return_reading = 65.53;
  double no_return_tolerance = 0.02;
};

/// True when the reading is a measured range: finite, positive, inside [range_min, range_max], not a no-return code.
/// +inf, NaN, 0, values below range_min or above range_max and 65.53 are all "no return".
bool isMeasuredRange(float range, const LaserScan& scan, const ScanLimits& limits = {});

/// The ranges of a scan by direction, in the base frame: what lies between the scanner and a range was seen to be free.
struct RangeProfile {
  Point2 origin;                 ///< where the scanner is, m
  double first_direction = 0.0;  ///< rad, of ranges[0]
  double increment = 0.0;        ///< rad from one range to the next; may be negative
  std::vector<float> ranges;     ///< m; +inf = nothing there, 0 = not known (lost beams, readings below range_min)

  double direction(std::size_t beam) const { return first_direction + static_cast<double>(beam) * increment; }
  /// False when it saw nothing, or when it is not known what it saw.
  bool isMeasured(std::size_t beam) const { return ranges[beam] > 0.0f && std::isfinite(ranges[beam]); }
  /// Index of the beam nearest to `direction` (rad, base frame); -1 when none is within an increment of it.
  long beamTowards(double direction) const;
};

/// Fills a profile from a scan; its memory is reused.
void toProfile(const LaserScan& scan, const SensorMount& mount, const ScanLimits& limits, RangeProfile* profile);

/// The measured returns as points in the base frame, m, in the order of the beams; no returns are left out.
/// `points` is overwritten; its memory is reused.
void toPoints(const LaserScan& scan, const SensorMount& mount, const ScanLimits& limits, std::vector<Point2>* points);

/// The same from a profile. The directions of the beams are kept from one scan to the next, which makes it ten times as
/// fast.
void toPoints(const RangeProfile& profile, BeamDirections* directions, std::vector<Point2>* points);

}  // namespace lstm_planner
