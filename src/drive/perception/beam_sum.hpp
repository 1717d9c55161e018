#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

/// What some neighbouring beams see.
struct BeamSum {
  double range = 0.0;                                      ///< m, of those that are known; each at most the cap
  float nearest = std::numeric_limits<float>::infinity();  ///< m; +inf where nothing is measured
  int measured = 0;                                        ///< with a range
  int known = 0;                                           ///< with a range, or seeing nothing
};

/// Of `count` neighbouring beams of a RangeProfile. `cap`: m.
inline BeamSum sumOfBeams(const float* ranges, std::size_t count, double cap) {
  BeamSum sum;
  std::for_each(ranges, ranges + count, [&](float range) {
    const bool is_silent = range == RangeProfile::kSilent;
    if (!is_silent && !(range > 0.0f)) return;
    ++sum.known;
    sum.measured += !is_silent && std::isfinite(range) ? 1 : 0;
    sum.range += is_silent ? cap : std::min<double>(range, cap);
    if (!is_silent) sum.nearest = std::min(sum.nearest, range);
  });
  return sum;
}

}  // namespace lstm_planner
