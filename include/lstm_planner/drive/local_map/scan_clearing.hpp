#pragma once

#include <vector>

#include "lstm_planner/drive/perception/beam_finder.hpp"

namespace lstm_planner {

/// Tells which places a scan shows clear: the beam towards the place and two on each side end at least 0.1 m behind it.
///
/// Places are relative to the scanner, m, in a frame in which the base has the yaw that was given to show().
class ScanClearing {
 public:
  /// Replaces the scan.
  void show(const RangeProfile& profile, double yaw);

  /// Nothing is cleared by a scan without beams.
  bool isBlind() const { return finder_.beams() == 0; }

  bool isClear(float x, float y) const {
    const long beam = finder_.beamTowards(x, y);
    return beam >= 0 && x * x + y * y < limits_[static_cast<std::size_t>(beam)];
  }

 private:
  BeamFinder finder_;
  std::vector<float> limits_;  ///< m^2; a beam each: farther places are not cleared
};

}  // namespace lstm_planner
