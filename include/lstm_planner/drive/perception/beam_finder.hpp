#pragma once

#include <algorithm>
#include <cmath>

#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

/// RangeProfile::beamTowards() for many places of one scan: without a call of the arc tangent, to 2e-5 rad.
class BeamFinder {
 public:
  /// No beams.
  BeamFinder() = default;

  /// For places in a frame in which the base has that yaw, rad. No beams where the profile's increment is 0.
  BeamFinder(const RangeProfile& profile, double yaw)
      : beams_(profile.increment != 0.0 ? static_cast<long>(profile.ranges.size()) : 0) {
    const double first = profile.first_direction + yaw;
    const double beams_a_turn = std::min(kMostBeamsATurn, kFullTurn / std::abs(profile.increment));
    beams_a_turn_ = static_cast<float>(beams_a_turn);
    beams_a_radian_ = static_cast<float>(beams_a_turn / kFullTurn);
    along_x_ = static_cast<float>(std::cos(first));
    along_y_ = static_cast<float>(std::sin(first));
    aside_ = profile.increment < 0.0 ? -1.0f : 1.0f;
  }

  /// Index of the beam nearest to a place; -1 when none is within an increment. `x` and `y`, m, are relative to the
  /// scanner.
  long beamTowards(float x, float y) const {
    const float along = along_x_ * x + along_y_ * y;
    const float aside = aside_ * (along_x_ * y - along_y_ * x);
    const float position = directionOf(along, aside) * beams_a_radian_;
    const auto beam = static_cast<long>(position + 0.5f);
    if (beam < beams_) return beam;
    // Just before the first beam is nearly a whole turn after it.
    if (beams_a_turn_ - position < 1.0f) return beams_ > 0 ? 0 : -1;
    return position < static_cast<float>(beams_) ? beams_ - 1 : -1;
  }

  long beams() const { return beams_; }

 private:
  /// More beams a turn than that are of no use, and would not fit into a float's digits.
  static constexpr double kMostBeamsATurn = 1e6;

  /// Direction of a vector, rad in [0, 2 pi], to 1.2e-5 rad: Abramowitz and Stegun, Handbook of Mathematical Functions,
  /// 4.4.49, in the first eighth of a turn.
  static float directionOf(float x, float y) {
    constexpr float kPi = 3.14159265358979f;
    constexpr float kTiny = 1e-30f;
    const float abs_x = std::abs(x);
    const float abs_y = std::abs(y);
    const float ratio = std::min(abs_x, abs_y) / std::max(std::max(abs_x, abs_y), kTiny);
    const float squared = ratio * ratio;
    float sum = squared * 0.0208351f - 0.0851330f;
    sum = sum * squared + 0.1801410f;
    sum = sum * squared - 0.3302995f;
    sum = sum * squared + 0.9998660f;
    float direction = ratio * sum;
    if (abs_y > abs_x) direction = 0.5f * kPi - direction;
    if (x < 0.0f) direction = kPi - direction;
    return y < 0.0f ? 2.0f * kPi - direction : direction;
  }

  long beams_ = 0;
  float beams_a_turn_ = 0.0f;
  float beams_a_radian_ = 0.0f;  ///< more than 0
  float along_x_ = 1.0f;         ///< direction of the first beam
  float along_y_ = 0.0f;
  float aside_ = 1.0f;  ///< -1 where beams follow one another clockwise
};

}  // namespace lstm_planner
