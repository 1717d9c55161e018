#pragma once

#include <costmap_2d/costmap_2d_ros.h>

#include <string>

#include "lstm_planner/common/footprint.hpp"

namespace lstm_planner {

/// The footprint that is safe to drive with: `own`, or the one that is set for a costmap (`footprint`, `robot_radius`)
/// where that reaches beyond; a warning says so. A costmap's footprint that is around many corners of a circle counts
/// as the circle. `parameter`: where the own one is set.
Footprint safeFootprint(const costmap_2d::Costmap2DROS& costmap, const Footprint& own, const std::string& parameter);

}  // namespace lstm_planner
