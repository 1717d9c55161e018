#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>

#include "lstm_planner/base/grid/occupancy_grid.hpp"

namespace lstm_planner {

constexpr int kGridRayCount = 8;

/// Cells that a ray looks ahead at most (thesis 3.2).
constexpr int kGridRayCap = 50;

/// Steps (column, row) of the eight rays: counter-clockwise from the x axis, in the order east, north-east, north,
/// north-west, west, south-west, south, south-east. Rows grow to the north.
constexpr std::array<CellIndex, kGridRayCount> kGridRaySteps = {
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// Costs of steps in fifths of a cell, whole numbers for searches; a diagonal one is 1 % less than the true ratio.
constexpr int kStraightFifths = 5;
constexpr int kDiagonalFifths = 7;

/// Cost of a path of so many columns and rows, which may be negative, where nothing is in between.
inline int octileFifths(int columns, int rows) {
  columns = std::abs(columns);
  rows = std::abs(rows);
  return kStraightFifths * std::max(columns, rows) + (kDiagonalFifths - kStraightFifths) * std::min(columns, rows);
}

/// Which of kGridRaySteps leads from one cell to the other; -1 when none does.
inline int rayBetween(CellIndex from, CellIndex to) {
  const auto found = std::find_if(kGridRaySteps.begin(), kGridRaySteps.end(), [&](CellIndex step) {
    return from.column + step.column == to.column && from.row + step.row == to.row;
  });
  return found == kGridRaySteps.end() ? -1 : static_cast<int>(found - kGridRaySteps.begin());
}

}  // namespace lstm_planner
