#include "lstm_planner/grid/range_table.hpp"

#include <algorithm>

namespace lstm_planner {

RangeTable::RangeTable(const PassableGrid& grid) : columns_(grid.columns()), ranges_(grid.size(), GridRanges{}) {
  // A cell sees one step further than its neighbour in that direction, so neighbours come first.
  for (int direction = 0; direction < kGridRayCount; ++direction) {
    const std::size_t ray = static_cast<std::size_t>(direction);
    const CellIndex step = kGridRaySteps[ray];
    for (int i = 0; i < grid.rows(); ++i) {
      const int row = step.row > 0 ? grid.rows() - 1 - i : i;
      for (int j = 0; j < grid.columns(); ++j) {
        const int column = step.column > 0 ? grid.columns() - 1 - j : j;
        if (!grid.passable({column, row})) continue;
        const CellIndex beside = cellBeside({column, row}, direction);
        const int seen = grid.passable(beside) ? ranges_[grid.offset(beside)][ray] : 0;
        ranges_[grid.offset({column, row})][ray] = static_cast<std::uint8_t>(std::min(seen + 1, kGridRayCap));
      }
    }
  }
}

}  // namespace lstm_planner
