#pragma once

#include <cstddef>

#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

/// RangeProfile::beamTowards() for many places at once, to 2e-5 rad.
class BeamFinder {
 public:
  /// No beams; find() must not be called.
  BeamFinder() = default;

  /// For places in a frame in which the base has that yaw, rad. A profile needs beams, and an increment other than 0.
  BeamFinder(const RangeProfile& profile, double yaw);

  /// Where the beams towards some places lie: in beams from the first one, from 0 to less than a whole turn. `x` and
  /// `y`, m, are relative to the scanner. All arrays are used up to the next multiple of four.
  void find(const float* x, const float* y, std::size_t count, float* positions) const;

  /// Index of the beam nearest to a position; -1 when none is within an increment.
  long beamAt(float position) const {
    const auto beam = static_cast<long>(position + 0.5f);
    return beam < beams_ ? beam : beamBeyond(position);
  }

  long beams() const { return beams_; }
  float beamsATurn() const { return beams_a_turn_; }
  float beamsARadian() const { return beams_a_radian_; }

 private:
  long beamBeyond(float position) const;

  long beams_ = 0;
  float beams_a_turn_ = 0.0f;
  float beams_a_radian_ = 0.0f;  ///< more than 0
  float along_x_ = 1.0f;         ///< direction of the first beam
  float along_y_ = 0.0f;
  float aside_ = 1.0f;  ///< -1 where beams follow one another clockwise
};

}  // namespace lstm_planner
