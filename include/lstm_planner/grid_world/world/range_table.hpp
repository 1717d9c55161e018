#pragma once

#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

/// What the thesis's agent senses in every cell of a grid, computed once: 8 bytes a cell, no rays. 0 in blocked cells.
class RangeTable {
 public:
  RangeTable() = default;
  explicit RangeTable(const PassableGrid& grid);

  /// `cell` must be inside and passable; blocked cells have 0 in all directions.
  const GridRanges& at(CellIndex cell) const { return ranges_[cell]; }

 private:
  CellField<GridRanges> ranges_;
};

}  // namespace lstm_planner
