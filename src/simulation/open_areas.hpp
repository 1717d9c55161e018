#pragma once

#include <opencv2/core.hpp>

#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// Numbers the areas of the floor (from 1; 0 = it does not fit) in which a disc of that radius (m) can go about: a row
/// a row of the grid. Returns how many there are.
int labelOpenAreas(const OccupancyGrid& grid, double radius, cv::Mat1i* labels);

}  // namespace lstm_planner
