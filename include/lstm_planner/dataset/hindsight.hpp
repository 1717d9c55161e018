#pragma once

#include <vector>

#include "lstm_planner/dataset/drive_events.hpp"

namespace lstm_planner {

/// Which places a driver who named no goals is taken to have driven to.
struct HindsightParameters {
  double stop = 2.0;       ///< s; where the robot stood this long it had arrived
  double longest = 10.0;   ///< m of way; at the latest after this much there was a goal
  double shortest = 2.0;   ///< m of way; nearer places are not goals
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const HindsightParameters& parameters);

/// The goals of a way, each with the stamp from which it was driven to, in the odometry frame `frame`. Odometry that jumps
/// (RecorderParameters::max_speed) or is silent for max_gap ends a way; the next goal lies on the next.
std::vector<GoalHeard> hindsightGoals(const std::vector<OdometryHeard>& way, const HindsightParameters& parameters,
                                      const RecorderParameters& recorder, const std::string& frame);

}  // namespace lstm_planner
