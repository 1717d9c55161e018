#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include "lstm_planner/base/grid/grid_rays.hpp"

namespace lstm_planner {

/// The cell so many steps ahead in a direction.
inline CellIndex alongRay(CellIndex cell, std::size_t direction, int steps) {
  const CellIndex step = kGridRaySteps[direction];
  return {cell.column + steps * step.column, cell.row + steps * step.row};
}

// Octile lengths in cells, as single precision is enough for what a network is told.

inline float rayLength(std::size_t direction, int steps) {
  return static_cast<float>(steps) * (direction % 2 != 0 ? 1.41421356f : 1.0f);
}

inline float octileCells(float columns, float rows) {
  return std::max(columns, rows) + 0.41421356f * std::min(columns, rows);
}

inline float octileCells(CellIndex a, CellIndex b) {
  return octileCells(static_cast<float>(std::abs(a.column - b.column)), static_cast<float>(std::abs(a.row - b.row)));
}

}  // namespace lstm_planner
