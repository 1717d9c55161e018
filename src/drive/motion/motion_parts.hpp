#pragma once

#include <algorithm>
#include <vector>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

constexpr double kSlack = 1e-9;  ///< m or rad of rounding

/// Share of the safety margin that is kept by a robot with corners that goes back where it was: the margin is at least
/// three times the noise of the scanner.
constexpr double kLeastMargin = 0.5;

/// Share of it that is kept by a robot with corners that has stood for long: the steps of ranges, of a map and of a
/// simulator's cells come on top of noise there.
constexpr double kNarrowMargin = 2.0 / 3.0;

/// Turning speed for each rad of heading error, 1/s: `gain`, or less where a turn is seen so late (`reaction_time`, s)
/// that the robot would turn too far to either side for ever.
inline double headingGain(double gain, double reaction_time) { return std::min(gain, 1.0 / reaction_time); }

inline double clampMagnitude(double value, double limit) { return std::max(-limit, std::min(limit, value)); }

/// The first pose of a plan, from `first` on, that is so far from the robot (m), or its last one.
inline const Pose2& firstBeyond(std::vector<Pose2>::const_iterator first, const std::vector<Pose2>& plan,
                                const Pose2& robot, double distance) {
  const auto isBeyond = [&](const Pose2& place) { return distanceBetween(place, robot) >= distance; };
  const auto beyond = std::find_if(first, plan.end(), isBeyond);
  return beyond == plan.end() ? plan.back() : *beyond;
}

}  // namespace lstm_planner
