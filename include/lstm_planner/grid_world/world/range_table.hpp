#pragma once

#include <algorithm>

#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

/// What the thesis's agent senses in every cell of a grid, computed once: 8 bytes a cell, no rays. 0 in blocked cells.
class RangeTable {
 public:
  RangeTable() = default;
  explicit RangeTable(const PassableGrid& grid) : ranges_(grid.columns(), grid.rows(), GridRanges{}) {
    // A cell sees one step further than its neighbour in that direction, so the neighbour comes first: row by row those
    // in directions 0 to 3 lie behind the cell, the others before it. Blocked cells hold 0.
    constexpr int kHalf = kGridRayCount / 2;
    const auto fill = [&](CellIndex cell, int first_direction) {
      if (!grid.passable(cell)) return;
      GridRanges& ranges = ranges_[cell];
      for (int direction = first_direction; direction < first_direction + kHalf; ++direction) {
        const std::size_t ray = static_cast<std::size_t>(direction);
        const CellIndex beside = cellBeside(cell, direction);
        const int seen = grid.contains(beside) ? ranges_[beside][ray] : 0;
        ranges[ray] = static_cast<std::uint8_t>(std::min(seen + 1, kGridRayCap));
      }
    };
    for (int row = grid.rows(); row-- > 0;) {
      for (int column = grid.columns(); column-- > 0;) fill({column, row}, 0);
    }
    for (const CellIndex cell : grid.cells()) fill(cell, kHalf);
  }

  /// `cell` must be inside and passable; blocked cells have 0 in all directions.
  const GridRanges& at(CellIndex cell) const { return ranges_[cell]; }

 private:
  CellField<GridRanges> ranges_;
};

}  // namespace lstm_planner
