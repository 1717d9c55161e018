#pragma once

#include <cstddef>

#include "drive/perception/baseline_vectors.hpp"
#include "lstm_planner/drive/collision/shield.hpp"

namespace lstm_planner {

/// Neighbours of a scan lie near one another: whole groups of them need not be looked at. Each has as many x, then as
/// many y.
constexpr std::size_t kReturnsAGroup = 16;

/// The boxes around groups come in blocks: x of the middles, then y, half widths, half heights, as many of each.
constexpr std::size_t kGroupsABlock = kLanes;
constexpr std::size_t kNumbersABlock = 4 * kGroupsABlock;

/// A return must come this much nearer before it counts as coming nearer, m: less than the noise of any scanner.
constexpr double kShieldTouchSlack = 1e-3;

template <typename Meet, typename Visit>
void Shield::visitGroups(const Meet& meet, const Visit& visit) const {
  for (std::size_t first = 0; first < groups_; first += kLanes) {
    const float* const boxes = &boxes_[first / kGroupsABlock * kNumbersABlock];
    const Ints met = meet(loadFloats(boxes), loadFloats(boxes + kGroupsABlock), loadFloats(boxes + 2 * kGroupsABlock),
                          loadFloats(boxes + 3 * kGroupsABlock));
    if (!any(met)) {
      continue;
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (met[lane] != 0 && first + lane < groups_ && visit(&places_[2 * kReturnsAGroup * (first + lane)])) {
        return;
      }
    }
  }
}

template <typename Visit>
void Shield::visitNear(const Point2& from, double distance, const Visit& visit) const {
  const Floats x = allOf(static_cast<float>(from.x));
  const Floats y = allOf(static_cast<float>(from.y));
  const Floats wide = allOf(static_cast<float>(distance + blur(from)));
  const auto meet = [&](Floats middle_x, Floats middle_y, Floats half_x, Floats half_y) {
    return (magnitude(middle_x - x) <= half_x + wide) & (magnitude(middle_y - y) <= half_y + wide);
  };
  visitGroups(meet, [&](const double* places) {
    for (std::size_t i = 0; i < kReturnsAGroup; ++i) {
      if (visit(Point2{places[i], places[kReturnsAGroup + i]})) {
        return true;
      }
    }
    return false;
  });
}

}  // namespace lstm_planner
