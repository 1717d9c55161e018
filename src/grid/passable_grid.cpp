#include "lstm_planner/grid/passable_grid.hpp"

#include <stdexcept>
#include <string>

namespace lstm_planner {
namespace {

bool isDiagonal(int direction) { return direction % 2 != 0; }

}  // namespace

PassableGrid::PassableGrid(int columns, int rows, bool passable) {
  if (columns < 1 || rows < 1 || std::int64_t{columns} * rows > kMostCells) {
    throw std::invalid_argument("a grid of " + std::to_string(columns) + " x " + std::to_string(rows) +
                                " cells, expected positive sizes and at most 2^26 cells");
  }
  CellField::operator=(CellField(columns, rows, passable ? 1 : 0));
}

bool movePossible(const PassableGrid& grid, CellIndex cell, int direction, CornerCutting corner_cutting) {
  if (!grid.passable(cellBeside(cell, direction))) return false;
  if (!isDiagonal(direction) || corner_cutting == CornerCutting::kAllowed) return true;
  return grid.passable(cellBeside(cell, turned(direction, -1))) &&
         grid.passable(cellBeside(cell, turned(direction, 1)));
}

bool movePossible(const GridRanges& ranges, int direction, CornerCutting corner_cutting) {
  const auto isFree = [&](int beside) { return ranges[static_cast<std::size_t>(beside)] > 1; };
  if (!isFree(direction)) return false;
  if (!isDiagonal(direction) || corner_cutting == CornerCutting::kAllowed) return true;
  return isFree(turned(direction, -1)) && isFree(turned(direction, 1));
}

}  // namespace lstm_planner
