#pragma once

#include <algorithm>
#include <array>

#include "lstm_planner/base/grid/occupancy_grid.hpp"

namespace lstm_planner {

constexpr int kGridRayCount = 8;

/// Cells that a ray looks ahead at most (thesis 3.2).
constexpr int kGridRayCap = 50;

/// Steps (column, row) of the eight rays: counter-clockwise from the x axis, in the order east, north-east, north,
/// north-west, west, south-west, south, south-east. Rows grow to the north.
constexpr std::array<CellIndex, kGridRayCount> kGridRaySteps = {
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// Which of kGridRaySteps leads from one cell to the other; -1 when none does.
inline int rayBetween(CellIndex from, CellIndex to) {
  const auto found = std::find_if(kGridRaySteps.begin(), kGridRaySteps.end(), [&](CellIndex step) {
    return from.column + step.column == to.column && from.row + step.row == to.row;
  });
  return found == kGridRaySteps.end() ? -1 : static_cast<int>(found - kGridRaySteps.begin());
}

/// The proximity ranges of thesis Eq. 3.1 around a cell, in cells, in the order of kGridRaySteps: the number of steps
/// to the first cell that is not free (1 when the neighbour is blocked, at most kGridRayCap), times sqrt(2) on
/// diagonals. Occupied and unknown cells block, and so does the outside of the map. A diagonal ray passes between two
/// blocked cells that touch at a corner only: it looks at the cells of its own diagonal.
std::array<double, kGridRayCount> gridRays(const OccupancyGrid& grid, CellIndex cell);

}  // namespace lstm_planner
