#pragma once

#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/collision/shield.hpp"

namespace lstm_planner {

/// A short manoeuvre after which a robot with corners, which is wedged in, can drive along its plan: it drives forwards
/// and turns where the footprint, grown by `margin` (m), fits through the returns, and backwards only where it was. The
/// way that it came counts as free with three quarters of the margin.
///
///        turns here
///          ^
///        | | |     The robot (R, headed upwards) has no room to turn to its plan (p), which leads down.
///        | R |     It drives on to where there is room.
///        | p |
///
/// Everything in the base frame. `was`: poses where the robot was. `plan`: from about where it is. The poses of the
/// manoeuvre are at most 2 cm or 0.05 rad apart, from the robot on; the last one heads along the plan, with 0.3 m free
/// ahead. Empty where there is none within 2 m.
///
/// Dijkstra's search over places of 4 cm and headings of 0.1 rad (hybrid A*, Dolgov et al. 2008, without its
/// heuristics).
std::vector<Pose2> findWayOut(const Shield& shield, double margin, const std::vector<Pose2>& was,
                              const std::vector<Pose2>& plan);

}  // namespace lstm_planner
