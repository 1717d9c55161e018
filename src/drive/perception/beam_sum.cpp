#include "drive/perception/beam_sum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

BeamSum sumOfBeams(const float* ranges, std::size_t count, double cap) {
  BeamSum sum;
  std::for_each(ranges, ranges + count, [&](float range) {
    const bool sees = range > 0.0f;
    sum.silent += range == RangeProfile::kSilent ? 1 : 0;
    sum.known += sees || range == RangeProfile::kSilent ? 1 : 0;
    sum.measured += sees && std::isfinite(range) ? 1 : 0;
    if (sees) sum.nearest = std::min(sum.nearest, range);
    if (sees || range == RangeProfile::kSilent) sum.range += sees ? std::min<double>(range, cap) : cap;
  });
  return sum;
}

}  // namespace lstm_planner
