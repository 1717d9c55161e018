#pragma once

#include <random>
#include <vector>

#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

/// A grid with about `blocked_percent` of its cells blocked, and none of `kept_free`.
inline PassableGrid randomGrid(int columns, int rows, unsigned blocked_percent, std::mt19937& random,
                               const std::vector<CellIndex>& kept_free = {}) {
  PassableGrid grid(columns, rows, true);
  for (const CellIndex cell : grid.cells()) grid.set(cell, random() % 100 >= blocked_percent);
  for (const CellIndex cell : kept_free) grid.set(cell, true);
  return grid;
}

}  // namespace lstm_planner
