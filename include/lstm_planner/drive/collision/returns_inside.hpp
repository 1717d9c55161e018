#pragma once

#include <string>
#include <vector>

#include "lstm_planner/common/footprint.hpp"
#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// What to tell a user whose robot stands because returns (base frame, m) lie inside the footprint: mostly the scanner
/// sees a part of the robot. Empty if none lies deeper than the noise of a scanner.
std::string returnsInside(const std::vector<Point2>& returns, const Footprint& footprint);

}  // namespace lstm_planner
