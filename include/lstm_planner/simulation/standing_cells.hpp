#pragma once

#include <vector>

#include "lstm_planner/grid/distance_field.hpp"
#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

/// m from the centre of a cell to that of the nearest obstacle which a disc needs there: the obstacle starts half a
/// cell before.
inline double distanceNeeded(double radius, const OccupancyGrid& grid) { return radius + 0.5 * grid.resolution(); }

/// Free cells on which such a disc can stand, row by row.
inline std::vector<CellIndex> standingCells(const OccupancyGrid& grid, const DistanceField& distances, double needed) {
  std::vector<CellIndex> cells;
  for (const CellIndex cell : grid.cells()) {
    if (grid.at(cell) == Cell::kFree && distances.at(cell) >= needed) cells.push_back(cell);
  }
  return cells;
}

}  // namespace lstm_planner
