#include "lstm_planner/grid_world/search/grid_path.hpp"

#include <cmath>
#include <utility>

#include "lstm_planner/common/parameter_check.hpp"

namespace lstm_planner {

MoveCosts moveCosts(double straight, double diagonal) {
  checkRange("straight_cost", straight, 0.01, 100.0);
  checkRange("diagonal_cost", diagonal, straight, 2.0 * straight);
  const auto cost = [](double cells) { return std::llround(cells * static_cast<double>(kStraightCost)); };
  return {cost(straight), cost(diagonal)};
}

GridPath pathAlong(std::vector<CellIndex> cells) {
  GridPath path;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    ++(rayBetween(cells[i - 1], cells[i]) % 2 == 0 ? path.straight_moves : path.diagonal_moves);
  }
  path.cells = std::move(cells);
  return path;
}

}  // namespace lstm_planner
