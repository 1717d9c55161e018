#include "lstm_planner/drive/local_map/scan_clearing.hpp"

#include <algorithm>

namespace lstm_planner {

namespace {

/// Noise, and beams that graze a wall, must not make it seem cleared.
constexpr float kBehindObstacle = 0.1f;
constexpr std::ptrdiff_t kBeside = 2;

}  // namespace

void ScanClearing::show(const RangeProfile& profile, double yaw) {
  finder_ = BeamFinder(profile, yaw);
  const auto beams = static_cast<std::ptrdiff_t>(profile.ranges.size());
  limits_.resize(profile.ranges.size());
  for (std::ptrdiff_t beam = 0; beam < beams; ++beam) {
    const auto first = profile.ranges.begin() + std::max<std::ptrdiff_t>(0, beam - kBeside);
    const auto last = profile.ranges.begin() + std::min(beams, beam + kBeside + 1);
    const float nearest = std::min(*std::min_element(first, last), profile.farthestRange());
    const float before = std::max(nearest - kBehindObstacle, 0.0f);
    limits_[static_cast<std::size_t>(beam)] = before * before;
  }
}

}  // namespace lstm_planner
