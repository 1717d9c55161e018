#include "lstm_planner/robot/perception/beam_finder.hpp"

#include <algorithm>
#include <cmath>

#include "robot/perception/scan_kernels.hpp"

namespace lstm_planner {

namespace {

/// More beams a turn than that are of no use, and would not fit into a float's digits.
constexpr double kMostBeamsATurn = 1e6;

}  // namespace

BeamFinder::BeamFinder(const RangeProfile& profile, double yaw) : beams_(static_cast<long>(profile.ranges.size())) {
  const double first = profile.first_direction + yaw;
  const double beams_a_turn = std::min(kMostBeamsATurn, kFullTurn / std::abs(profile.increment));
  beams_a_turn_ = static_cast<float>(beams_a_turn);
  first_.beams_a_radian = static_cast<float>(beams_a_turn / kFullTurn);
  first_.along_x = static_cast<float>(std::cos(first));
  first_.along_y = static_cast<float>(std::sin(first));
  first_.aside = profile.increment < 0.0 ? -1.0f : 1.0f;
}

void BeamFinder::find(const float* x, const float* y, std::size_t count, float* positions) const {
  scanKernels().find(first_, x, y, count, positions);
}

long BeamFinder::beamBeyond(float position) const {
  // Just before the first beam is nearly a whole turn after it.
  if (beams_a_turn_ - position < 1.0f) return 0;
  return position < static_cast<float>(beams_) ? beams_ - 1 : -1;
}

}  // namespace lstm_planner
