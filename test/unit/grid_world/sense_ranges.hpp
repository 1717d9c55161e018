#pragma once

#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

/// What the thesis's agent senses in a cell (Eq. 3.1), ray by ray: what RangeTable holds for all cells.
inline GridRanges senseRanges(const PassableGrid& grid, CellIndex cell) {
  GridRanges ranges{};
  for (int direction = 0; direction < kGridRayCount; ++direction) {
    CellIndex seen = cell;
    int steps = 0;
    do {
      seen = cellBeside(seen, direction);
      ++steps;
    } while (steps < kGridRayCap && grid.passable(seen));
    ranges[static_cast<std::size_t>(direction)] = static_cast<std::uint8_t>(steps);
  }
  return ranges;
}

}  // namespace lstm_planner
