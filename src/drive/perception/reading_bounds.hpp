#pragma once

#include <cstddef>

#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

/// What the readings of one scan mean. Measured is what is finite, positive, in [range_min, range_max] and no code for
/// no return.
struct ReadingBounds {
  float least;         ///< m, of what counts as measured; more than 0
  float most;          ///< m
  float nothing_from;  ///< m; such readings and greater ones are no returns
  float code_first;    ///< m; from here to
  float code_last;     ///< m, a reading is no return
  bool nan_is_silent;
  bool zero_is_silent;
  bool below_is_silent;
};

ReadingBounds readingBounds(const LaserScan& scan, const ScanRules& rules);

/// As RangeProfile::ranges what the readings of `count` beams mean.
void interpret(const ReadingBounds& bounds, const float* readings, std::size_t count, float* ranges);

}  // namespace lstm_planner
