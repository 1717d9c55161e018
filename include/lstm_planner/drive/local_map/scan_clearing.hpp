#pragma once

#include <algorithm>
#include <vector>

#include "lstm_planner/drive/perception/beam_finder.hpp"

namespace lstm_planner {

/// Tells which places a scan shows clear: the beam towards the place and two on each side end at least 0.1 m behind it.
///
/// Places are relative to the scanner, m, in a frame in which the base has the yaw that was given to show().
class ScanClearing {
 public:
  /// Replaces the scan.
  void show(const RangeProfile& profile, double yaw) {
    finder_ = BeamFinder(profile, yaw);
    limits_.resize(profile.ranges.size());
    for (std::size_t beam = 0; beam < limits_.size(); ++beam) {
      float nearest = profile.farthestRange();
      for (long aside = -kBeside; aside <= kBeside; ++aside) {
        const long beside = profile.beamAt(static_cast<long>(beam) + aside);
        if (beside >= 0) nearest = std::min(nearest, profile.ranges[static_cast<std::size_t>(beside)]);
      }
      const float before = std::max(nearest - kBehindObstacle, 0.0f);
      limits_[beam] = before * before;
    }
  }

  /// Nothing is cleared by a scan without beams.
  bool isBlind() const { return finder_.beams() == 0; }

  bool isClear(float x, float y) const {
    const long beam = finder_.beamTowards(x, y);
    return beam >= 0 && x * x + y * y < limits_[static_cast<std::size_t>(beam)];
  }

 private:
  /// Noise, and beams that graze a wall, must not make it seem cleared.
  static constexpr float kBehindObstacle = 0.1f;
  static constexpr long kBeside = 2;

  BeamFinder finder_;
  std::vector<float> limits_;  ///< m^2; a beam each: farther places are not cleared
};

}  // namespace lstm_planner
