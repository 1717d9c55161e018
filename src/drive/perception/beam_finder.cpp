#include "lstm_planner/drive/perception/beam_finder.hpp"

#include <algorithm>
#include <cmath>

#include "drive/perception/baseline_vectors.hpp"

namespace lstm_planner {

namespace {

/// More beams a turn than that are of no use, and would not fit into a float's digits.
constexpr double kMostBeamsATurn = 1e6;

/// Direction of vectors, rad in [0, 2 pi], to 1.2e-5 rad: Abramowitz and Stegun, Handbook of Mathematical Functions,
/// 4.4.49, in the first eighth of a turn.
Floats directionOf(Floats x, Floats y) {
  constexpr float kPi = 3.14159265358979f;
  constexpr float kTiny = 1e-30f;
  const Floats abs_x = magnitude(x);
  const Floats abs_y = magnitude(y);
  const Floats ratio = minimum(abs_x, abs_y) / maximum(maximum(abs_x, abs_y), allOf(kTiny));
  const Floats squared = ratio * ratio;
  Floats sum = squared * 0.0208351f - 0.0851330f;
  sum = sum * squared + 0.1801410f;
  sum = sum * squared - 0.3302995f;
  sum = sum * squared + 0.9998660f;
  Floats direction = ratio * sum;
  direction = abs_y > abs_x ? 0.5f * kPi - direction : direction;
  direction = x < Floats{} ? kPi - direction : direction;
  return y < Floats{} ? 2.0f * kPi - direction : direction;
}

}  // namespace

BeamFinder::BeamFinder(const RangeProfile& profile, double yaw) : beams_(static_cast<long>(profile.ranges.size())) {
  const double first = profile.first_direction + yaw;
  const double beams_a_turn = std::min(kMostBeamsATurn, kFullTurn / std::abs(profile.increment));
  beams_a_turn_ = static_cast<float>(beams_a_turn);
  beams_a_radian_ = static_cast<float>(beams_a_turn / kFullTurn);
  along_x_ = static_cast<float>(std::cos(first));
  along_y_ = static_cast<float>(std::sin(first));
  aside_ = profile.increment < 0.0 ? -1.0f : 1.0f;
}

void BeamFinder::find(const float* x, const float* y, std::size_t count, float* positions) const {
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Floats dx = loadFloats(x + i);
    const Floats dy = loadFloats(y + i);
    const Floats along = along_x_ * dx + along_y_ * dy;
    const Floats aside = aside_ * (along_x_ * dy - along_y_ * dx);
    store(directionOf(along, aside) * beams_a_radian_, positions + i);
  }
}

long BeamFinder::beamBeyond(float position) const {
  // Just before the first beam is nearly a whole turn after it.
  if (beams_a_turn_ - position < 1.0f) return 0;
  return position < static_cast<float>(beams_) ? beams_ - 1 : -1;
}

}  // namespace lstm_planner
