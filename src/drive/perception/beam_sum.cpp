#include "drive/perception/beam_sum.hpp"

#include <algorithm>
#include <cmath>

#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

BeamSum sumOfBeams(const float* ranges, std::size_t count, double cap) {
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
