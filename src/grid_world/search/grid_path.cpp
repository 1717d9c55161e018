#include "lstm_planner/grid_world/search/grid_path.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "lstm_planner/common/parameter_check.hpp"

namespace lstm_planner {

MoveCosts moveCosts(double straight, double diagonal) {
  checkRange("the cost of a straight move", straight, 0.01, 100.0);
  checkRange("the cost of a diagonal move", diagonal, straight, 2.0 * straight);
  const auto cost = [](double cells) { return std::llround(cells * static_cast<double>(kStraightCost)); };
  return {cost(straight), cost(diagonal)};
}

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
