#pragma once

#include "lstm_planner/common/footprint.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner {

/// Whether one of the current scans shows a place (base frame, m) free: a beam towards it was measured and ends behind
/// it, and none beside it ends before. What was not measured, and what a reading for "no return" may hide, is not free.
bool isSeenFree(const Situation& situation, const Point2& place);

/// How far (m, at most `limit`) a footprint, grown by `margin` (m), can go straight back through places that are all
/// seen free. 0 where the robot's back is not seen.
double seenFreeBehind(const Situation& situation, const Footprint& footprint, double margin, double limit);

}  // namespace lstm_planner
