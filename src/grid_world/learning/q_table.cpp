#include "lstm_planner/grid_world/learning/q_table.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "lstm_planner/common/parameter_check.hpp"

namespace lstm_planner {

void validate(const QTableParameters& parameters) {
  checkParameter(parameters.learning_rate > 0.0 && parameters.learning_rate <= 1.0, "learning_rate",
                 parameters.learning_rate, "a number in (0, 1]");
  checkParameter(parameters.discount > 0.0 && parameters.discount <= 1.0, "discount", parameters.discount,
                 "a number in (0, 1]");
  checkParameter(parameters.exploration >= 0.0 && parameters.exploration <= 1.0, "exploration", parameters.exploration,
                 "a share in [0, 1]");
  checkAtLeastOne("max_steps", parameters.max_steps);
}

QTable::QTable(const QTableParameters& parameters, const PassableGrid& grid, CellIndex goal)
    : parameters_(parameters), grid_(grid), goal_(goal), values_(grid.size()) {
  validate(parameters);
  if (!grid.passable(goal)) throw std::invalid_argument("the goal of a table is blocked, expected a passable cell");
  for (const CellIndex cell : grid.cells()) {
    Values& values = values_[grid.offset(cell)];
    for (int direction = 0; direction < kGridMoveCount; ++direction) {
      const bool possible = grid.passable(cell) && movePossible(grid, cell, direction, parameters.corner_cutting);
      values[static_cast<std::size_t>(direction)] = possible ? 0.0f : -std::numeric_limits<float>::infinity();
    }
  }
}

int QTable::bestMove(CellIndex cell) const {
  const Values& values = valuesOf(cell);
  const auto best = std::max_element(values.begin(), values.end());
  return *best == -std::numeric_limits<float>::infinity() ? kNoPath : static_cast<int>(best - values.begin());
}

double QTable::value(CellIndex cell) const {
  if (cell == goal_) return 0.0;
  const Values& values = valuesOf(cell);
  return static_cast<double>(*std::max_element(values.begin(), values.end()));
}

int QTable::drawMove(CellIndex cell, Random& random) const {
  const int best = bestMove(cell);
  if (best == kNoPath || uniform(random) >= parameters_.exploration) return best;
  const Values& values = valuesOf(cell);
  int direction = 0;
  do {
    direction = static_cast<int>(uniformIndex(random, kGridMoveCount));
  } while (values[static_cast<std::size_t>(direction)] == -std::numeric_limits<float>::infinity());
  return direction;
}

int QTable::runEpisode(CellIndex start, Random& random) {
  CellIndex cell = start;
  int steps = 0;
  while (cell != goal_ && steps < parameters_.max_steps) {
    const int direction = drawMove(cell, random);
    if (direction == kNoPath) break;
    const CellIndex next = cellBeside(cell, direction);
    float& value = values_[grid_.offset(cell)][static_cast<std::size_t>(direction)];
    const double old_value = static_cast<double>(value);
    const double target = -moveLength(direction) + parameters_.discount * this->value(next);
    value = static_cast<float>(old_value + parameters_.learning_rate * (target - old_value));
    cell = next;
    ++steps;
  }
  steps_ += steps;
  return steps;
}

}  // namespace lstm_planner
