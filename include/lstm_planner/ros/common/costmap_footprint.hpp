#pragma once

#include <costmap_2d/costmap_2d_ros.h>

#include <string>

namespace lstm_planner {

/// Radius of the circle about the robot's middle that is safe to drive with, m: `radius`, or as far as the footprint
/// reaches that is set for a costmap (`footprint`, `robot_radius`), whichever is larger; a warning says so.
/// `parameter`: what the radius is called.
double safeFootprintRadius(const costmap_2d::Costmap2DROS& costmap, double radius, const std::string& parameter);

}  // namespace lstm_planner
