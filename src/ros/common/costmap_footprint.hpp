#pragma once

#include <costmap_2d/costmap_2d_ros.h>

#include <string>

#include "lstm_planner/common/footprint.hpp"

namespace lstm_planner {

/// The footprint that is safe to drive with: `own`, or the one that is set for a costmap (`footprint`, `robot_radius`)
/// where that reaches beyond; a warning says so. A costmap's footprint that is around many corners of a circle counts
/// as the circle. `parameter`: where the own one is set.
Footprint safeFootprint(const costmap_2d::Costmap2DROS& costmap, const Footprint& own, const std::string& parameter);

/// The same for a plugin's parameters, which lie behind `prefix`: their footprint becomes the safe one.
template <typename Parameters>
void takeSafeFootprint(const costmap_2d::Costmap2DROS& costmap, const std::string& prefix, Parameters* parameters) {
  const std::string parameter = prefix + (parameters->footprint.empty() ? "footprint_radius" : "footprint");
  const Footprint footprint = safeFootprint(costmap, footprintOf(*parameters), parameter);
  parameters->footprint_radius = footprint.circumscribedRadius();
  parameters->footprint = textOf(footprint);
}

}  // namespace lstm_planner
