#pragma once

#include "lstm_planner/robot/perception/laser_scan.hpp"
#include "robot/perception/scan_kernels.hpp"

namespace lstm_planner {

/// What the readings of one scan mean. Measured is what is finite, positive, in [range_min, range_max] and no code for
/// no return.
ReadingBounds readingBounds(const LaserScan& scan, const ScanRules& rules);

}  // namespace lstm_planner
