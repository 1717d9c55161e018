#pragma once

#include <cstddef>

#include "lstm_planner/grid/grid_rays.hpp"

namespace lstm_planner {

/// The cell so many steps ahead in a direction.
inline CellIndex alongRay(CellIndex cell, std::size_t direction, int steps) {
  const CellIndex step = kGridRaySteps[direction];
  return {cell.column + steps * step.column, cell.row + steps * step.row};
}

}  // namespace lstm_planner
