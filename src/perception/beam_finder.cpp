#include "lstm_planner/perception/beam_finder.hpp"

#include <algorithm>
#include <cmath>

#include "perception/lanes.hpp"

namespace lstm_planner {

namespace {

constexpr double kTurn = 2.0 * M_PI;

/// More beams a turn than that are of no use, and would not fit into a float's digits.
constexpr double kMostBeams = 1e6;

/// Direction of vectors, rad in [0, 2 pi], to 1.2e-5 rad: Abramowitz and Stegun, Handbook of Mathematical Functions,
/// 4.4.49, in the first eighth of a turn.
Floats directionOf(Floats x, Floats y) {
  constexpr float kTiny = 1e-30f;
  const Floats abs_x = magnitude(x);
  const Floats abs_y = magnitude(y);
  const Floats ratio = lesser(abs_x, abs_y) / greater(greater(abs_x, abs_y), allOf(kTiny));
  const Floats squared = ratio * ratio;
  Floats sum = squared * allOf(0.0208351f) + allOf(-0.0851330f);
  sum = sum * squared + allOf(0.1801410f);
  sum = sum * squared + allOf(-0.3302995f);
  sum = sum * squared + allOf(0.9998660f);
  Floats direction = ratio * sum;
  direction = select(abs_y > abs_x, allOf(static_cast<float>(M_PI_2)) - direction, direction);
  direction = select(x < Floats{}, allOf(static_cast<float>(M_PI)) - direction, direction);
  return select(y < Floats{}, allOf(static_cast<float>(kTurn)) - direction, direction);
}

}  // namespace

BeamFinder::BeamFinder(const RangeProfile& profile, double yaw)
    : beams_(static_cast<long>(profile.ranges.size())), aside_(profile.increment < 0.0 ? -1.0f : 1.0f) {
  const double first = profile.first_direction + yaw;
  const double beams_a_turn = std::min(kMostBeams, kTurn / std::abs(profile.increment));
  beams_a_turn_ = static_cast<float>(beams_a_turn);
  beams_a_radian_ = static_cast<float>(beams_a_turn / kTurn);
  along_x_ = static_cast<float>(std::cos(first));
  along_y_ = static_cast<float>(std::sin(first));
}

void BeamFinder::find(const float* x, const float* y, std::size_t count, float* positions) const {
  const Floats along_x = allOf(along_x_);
  const Floats along_y = allOf(along_y_);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Floats xs = loadFloats(x + i);
    const Floats ys = loadFloats(y + i);
    const Floats along = along_x * xs + along_y * ys;
    const Floats aside = allOf(aside_) * (along_x * ys - along_y * xs);
    store(directionOf(along, aside) * allOf(beams_a_radian_), positions + i);
  }
}

long BeamFinder::beamBeyond(float position) const {
  // Just before the first beam is nearly a whole turn after it.
  if (beams_a_turn_ - position < 1.0f) return 0;
  return position < static_cast<float>(beams_) ? beams_ - 1 : -1;
}

}  // namespace lstm_planner
