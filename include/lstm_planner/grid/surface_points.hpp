#pragma once

#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// Points on the borders between occupied and other cells, at most `spacing` (m) apart and with the corners: a scanner
/// could see them. Map frame, m. Throws std::invalid_argument for a spacing that is not positive.
std::vector<Point2> surfacePoints(const OccupancyGrid& grid, double spacing);

}  // namespace lstm_planner
