#pragma once

#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

/// Length of the shortest path from every cell of a known grid to one goal, in cells, computed by buckets of width 1
/// (Dial's algorithm: no move is shorter, so the order within a bucket does not matter).
class GridDistances {
 public:
  GridDistances() = default;
  /// If the goal is outside or in a wall, no cell has a path to it.
  GridDistances(const PassableGrid& grid, CellIndex goal, CornerCutting corner_cutting);

  /// +inf outside and where there is no path, or one of 2^24 cells or more.
  float at(CellIndex cell) const;

 private:
  CellField<float> lengths_;
};

}  // namespace lstm_planner
