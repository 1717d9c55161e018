#pragma once

#include <vector>

#include "lstm_planner/grid/distance_field.hpp"
#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// The distance that a disc needs from the centre of its cell to that of the nearest occupied cell, m: the obstacle
/// starts half a cell before its centre.
inline double distanceNeeded(double radius, const OccupancyGrid& grid) { return radius + 0.5 * grid.resolution(); }

/// Free cells, row by row, that are at least `needed` (m, distanceNeeded()) from all obstacles.
inline std::vector<CellIndex> standingCells(const OccupancyGrid& grid, const DistanceField& distances, double needed) {
  std::vector<CellIndex> cells;
  for (const CellIndex cell : grid.cells()) {
    if (grid.at(cell) == Cell::kFree && distances.at(cell) >= needed) cells.push_back(cell);
  }
  return cells;
}

}  // namespace lstm_planner
