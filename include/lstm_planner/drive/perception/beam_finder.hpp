#pragma once

#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

/// RangeProfile::beamTowards() for many places of one scan: without a call of the arc tangent, to 2e-5 rad.
class BeamFinder {
 public:
  /// No beams.
  BeamFinder() = default;

  /// For places in a frame in which the base has that yaw, rad. No beams where the profile's increment is 0.
  BeamFinder(const RangeProfile& profile, double yaw);

  /// Index of the beam nearest to a place; -1 when none is within an increment. `x` and `y`, m, are relative to the
  /// scanner.
  long beamTowards(float x, float y) const;

  long beams() const { return beams_; }

 private:
  long beams_ = 0;
  float beams_a_turn_ = 0.0f;
  float beams_a_radian_ = 0.0f;  ///< more than 0
  float along_x_ = 1.0f;         ///< direction of the first beam
  float along_y_ = 0.0f;
  float aside_ = 1.0f;  ///< -1 where beams follow one another clockwise
};

}  // namespace lstm_planner
