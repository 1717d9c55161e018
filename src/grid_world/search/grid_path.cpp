#include "lstm_planner/grid_world/search/grid_path.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace lstm_planner {

int directionBetween(CellIndex from, CellIndex to) {
  const int direction = rayBetween(from, to);
  if (direction >= 0) return direction;
  throw std::invalid_argument("a move by " + std::to_string(to.column - from.column) + " columns and " +
                              std::to_string(to.row - from.row) + " rows, expected one of the eight cells around");
}

GridPath pathAlong(std::vector<CellIndex> cells) {
  GridPath path;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    ++(directionBetween(cells[i - 1], cells[i]) % 2 == 0 ? path.straight_moves : path.diagonal_moves);
  }
  path.cells = std::move(cells);
  return path;
}

}  // namespace lstm_planner
