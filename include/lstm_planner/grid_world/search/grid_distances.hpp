#pragma once

#include <limits>

#include "lstm_planner/grid/distance_field.hpp"

namespace lstm_planner {

/// Length of the shortest path from every cell of a known grid to one goal, in cells.
class GridDistances {
 public:
  GridDistances() = default;
  /// If the goal is outside or in a wall, no cell has a path to it.
  GridDistances(const PassableGrid& grid, CellIndex goal, CornerCutting corner_cutting)
      : lengths_(pathLengths(grid, goal, corner_cutting, 1.0)) {}

  /// +inf outside and where there is no path, or one of 2^24 cells or more.
  float at(CellIndex cell) const { return lengths_.at(cell, std::numeric_limits<float>::infinity()); }

 private:
  CellField<float> lengths_;
};

}  // namespace lstm_planner
