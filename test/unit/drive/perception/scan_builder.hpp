#pragma once

#include <cstddef>

#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

inline LaserScan makeScan(double angle_min, double angle_increment, std::size_t beams, float range = 2.0f) {
  LaserScan scan;
  scan.angle_min = angle_min;
  scan.angle_increment = angle_increment;
  scan.range_min = 0.023;
  scan.range_max = 60.0;
  scan.ranges.assign(beams, range);
  return scan;
}

/// The UTM-30LX-EW as its driver reports it: 1081 beams over 270 degrees.
inline LaserScan makeHokuyoScan(float range = 2.0f) { return makeScan(-2.35619, 0.00436332, 1081, range); }

}  // namespace lstm_planner
