#pragma once

#include "lstm_planner/robot/driving/shield.hpp"
#include "robot/perception/baseline_vectors.hpp"

namespace lstm_planner {

/// A return must come this much nearer before it counts as coming nearer, m: less than the noise of any scanner.
constexpr double kShieldTouchSlack = 1e-3;

template <typename Meet, typename Visit>
void Shield::visitGroups(const Meet& meet, const Visit& visit) const {
  for (std::size_t first = 0; first < groups_; first += kLanes) {
    const Ints met = meet(loadFloats(&middle_x_[first]), loadFloats(&middle_y_[first]), loadFloats(&half_x_[first]),
                          loadFloats(&half_y_[first]));
    if (!any(met)) {
      continue;
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (met[lane] != 0 && first + lane < groups_ && visit((first + lane) * kGroup)) {
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
  visitGroups(meet, [&](std::size_t group) {
    for (std::size_t i = group; i < group + kGroup; ++i) {
      if (visit(Point2{x_[i], y_[i]})) {
        return true;
      }
    }
    return false;
  });
}

}  // namespace lstm_planner
