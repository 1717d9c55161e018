#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "lstm_planner/robot/perception/laser_scan.hpp"
#include "robot/perception/baseline_vectors.hpp"

namespace lstm_planner {

/// What the readings of one scan mean, four at once. Measured is what is finite, positive, in [range_min, range_max]
/// and no code for no return.
class ReadingBounds {
 public:
  ReadingBounds(const LaserScan& scan, const ScanRules& rules)
      : least_(std::max(std::numeric_limits<float>::denorm_min(), toFloat(scan.range_min))),
        most_(std::min(std::numeric_limits<float>::max(), toFloat(scan.range_max))),
        nothing_from_(rules.beyond_is_no_return ? std::nextafter(most_, kInfinity) : kInfinity),
        nan_is_silent_(rules.nan_is_no_return ? -1 : 0),
        zero_is_silent_(rules.zero_is_no_return ? -1 : 0),
        below_is_silent_(rules.below_is_no_return ? -1 : 0) {
    if (rules.no_return_code == 0.0) return;
    code_first_ = static_cast<float>(rules.no_return_code - kCodeTolerance);
    code_last_ = static_cast<float>(rules.no_return_code + kCodeTolerance);
    // Rounding to a float must not move a reading over a bound that is a double.
    const auto isCode = [&](float reading) { return std::abs(reading - rules.no_return_code) <= kCodeTolerance; };
    if (!isCode(code_first_)) code_first_ = std::nextafter(code_first_, kInfinity);
    if (!isCode(code_last_)) code_last_ = std::nextafter(code_last_, -kInfinity);
  }

  /// As RangeProfile::ranges.
  Floats meaning(Floats readings) const {
    const Ints nothing = (readings >= allOf(nothing_from_)) | areCodes(readings);
    const Ints plain = areMeasured(readings) & ~nothing;
    if (!any(~plain)) return readings;  // nearly always
    const Ints silent = ((readings != readings) & allOf(nan_is_silent_)) |
                        ((readings == Floats{}) & allOf(zero_is_silent_)) |
                        ((readings > Floats{}) & (readings < allOf(least_)) & allOf(below_is_silent_));
    const Ints too_near = readings == allOf(-kInfinity);
    Floats meaning = select(areMeasured(readings), readings, Floats{});
    meaning = select(silent, allOf(RangeProfile::kSilent), meaning);
    meaning = select(too_near, readings, meaning);
    return select(nothing, allOf(kInfinity), meaning);
  }

 private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  static constexpr double kCodeTolerance = 0.02;  // m

  static float toFloat(double range) {
    return static_cast<float>(std::min<double>(range, std::numeric_limits<float>::max()));
  }
  Ints areMeasured(Floats readings) const { return (readings >= allOf(least_)) & (readings <= allOf(most_)); }
  Ints areCodes(Floats readings) const { return (readings >= allOf(code_first_)) & (readings <= allOf(code_last_)); }

  float least_;                 ///< m, of what counts as measured
  float most_;                  ///< m
  float nothing_from_;          ///< m; such readings and greater ones are no returns
  std::int32_t nan_is_silent_;  ///< a mask
  std::int32_t zero_is_silent_;
  std::int32_t below_is_silent_;
  float code_first_ = kInfinity;  ///< m; from here to
  float code_last_ = -kInfinity;  ///< m, a reading is no return
};

}  // namespace lstm_planner
