#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>

#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

constexpr int kGridRayCount = 8;

/// The largest range of a ray, cells (thesis 3.2).
constexpr int kGridRayCap = 50;

/// Steps (columns, rows) of the eight rays, counter-clockwise from the x axis: east, north-east, north, north-west,
/// west, south-west, south, south-east. Rows increase to the north.
constexpr std::array<CellIndex, kGridRayCount> kGridRaySteps = {
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// Costs of steps in fifths of a cell, as integers for searches. That of a diagonal step is 1 % too low.
constexpr int kStraightFifths = 5;
constexpr int kDiagonalFifths = 7;

/// The steps of a shortest path over so many columns and rows (of any sign) without obstacles.
template <typename Integer>
struct OctileSteps {
  OctileSteps(Integer columns, Integer rows)
      : straight(std::abs(std::abs(columns) - std::abs(rows))), diagonal(std::min(std::abs(columns), std::abs(rows))) {}

  Integer straight;
  Integer diagonal;
};

/// Cost of such a path, in fifths of a cell.
inline int octileFifths(int columns, int rows) {
  const OctileSteps steps(columns, rows);
  return kStraightFifths * steps.straight + kDiagonalFifths * steps.diagonal;
}

/// The direction so many eighths of a turn to the left of another; of any sign.
inline int turned(int direction, int eighths) { return (direction + eighths) & (kGridRayCount - 1); }
inline int opposite(int direction) { return turned(direction, kGridRayCount / 2); }

/// The index in kGridRaySteps of the step from one cell to the other; -1 if there is none.
inline int rayBetween(CellIndex from, CellIndex to) {
  const auto found = std::find_if(kGridRaySteps.begin(), kGridRaySteps.end(), [&](CellIndex step) {
    return from.column + step.column == to.column && from.row + step.row == to.row;
  });
  return found == kGridRaySteps.end() ? -1 : static_cast<int>(found - kGridRaySteps.begin());
}

}  // namespace lstm_planner
