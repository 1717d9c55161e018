#include "lstm_planner/grid/passable_grid.hpp"

#include <stdexcept>
#include <string>

namespace lstm_planner {
namespace {

int before(int direction) { return (direction + kGridMoveCount - 1) % kGridMoveCount; }
int after(int direction) { return (direction + 1) % kGridMoveCount; }
bool isDiagonal(int direction) { return direction % 2 != 0; }

}  // namespace

PassableGrid::PassableGrid(int columns, int rows, bool passable) : columns_(columns), rows_(rows) {
  if (columns < 1 || rows < 1 || std::int64_t{columns} * rows > kMostCells) {
    throw std::invalid_argument("a grid of " + std::to_string(columns) + " x " + std::to_string(rows) +
                                " cells, expected positive sizes and at most 2^26 cells");
  }
  cells_.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), passable ? 1 : 0);
}

bool movePossible(const PassableGrid& grid, CellIndex cell, int direction, CornerCutting corner_cutting) {
  if (!grid.passable(cellBeside(cell, direction))) return false;
  if (!isDiagonal(direction) || corner_cutting == CornerCutting::kAllowed) return true;
  return grid.passable(cellBeside(cell, before(direction))) && grid.passable(cellBeside(cell, after(direction)));
}

bool movePossible(const GridRanges& ranges, int direction, CornerCutting corner_cutting) {
  const auto isFree = [&](int beside) { return ranges[static_cast<std::size_t>(beside)] > 1; };
  if (!isFree(direction)) return false;
  if (!isDiagonal(direction) || corner_cutting == CornerCutting::kAllowed) return true;
  return isFree(before(direction)) && isFree(after(direction));
}

}  // namespace lstm_planner
