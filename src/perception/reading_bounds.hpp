#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "lstm_planner/perception/laser_scan.hpp"
#include "perception/lanes.hpp"

namespace lstm_planner {

/// isMeasuredRange() for the readings of one scan, four at once.
class ReadingBounds {
 public:
  ReadingBounds(const LaserScan& scan, const ScanLimits& limits)
      : least_(std::max(std::numeric_limits<float>::denorm_min(), static_cast<float>(scan.range_min))),
        most_(std::min(std::numeric_limits<float>::max(), static_cast<float>(scan.range_max))),
        range_max_(static_cast<float>(scan.range_max)),
        code_first_(static_cast<float>(limits.no_return_reading - limits.no_return_tolerance)),
        code_last_(static_cast<float>(limits.no_return_reading + limits.no_return_tolerance)) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    // Rounding to a float must not move a reading over a bound that is a double.
    const auto isCode = [&](float reading) {
      return std::abs(reading - limits.no_return_reading) <= limits.no_return_tolerance;
    };
    if (!isCode(code_first_)) code_first_ = std::nextafter(code_first_, kInfinity);
    if (!isCode(code_last_)) code_last_ = std::nextafter(code_last_, -kInfinity);
  }

  Ints areMeasured(Floats readings) const {
    return (readings >= allOf(least_)) & (readings <= allOf(most_)) & ~areCodes(readings);
  }

  /// Readings that mean that nothing is there.
  Ints areNothing(Floats readings) const { return (readings > allOf(range_max_)) | areCodes(readings); }

 private:
  Ints areCodes(Floats readings) const {
    return (readings >= allOf(code_first_)) & (readings <= allOf(code_last_));
  }

  float least_;  ///< m, of what counts as measured
  float most_;   ///< m
  float range_max_;
  float code_first_;  ///< m; from here to
  float code_last_;   ///< m, a reading is no range
};

}  // namespace lstm_planner
