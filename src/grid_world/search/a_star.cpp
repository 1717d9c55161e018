#include "grid_world/search/a_star.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "grid_world/search/possible_moves.hpp"

namespace lstm_planner {
namespace {

std::array<bool, kGridMoveCount> passableAround(const PassableGrid& grid, CellIndex cell) {
  std::array<bool, kGridMoveCount> passable;
  for (std::size_t i = 0; i < passable.size(); ++i) passable[i] = grid.passable(cellBeside(cell, static_cast<int>(i)));
  return passable;
}

}  // namespace

/// Among equal estimates the cell nearer to the goal comes first: it spares most of a plateau of equally good paths.
struct AStar::Later {
  bool operator()(const Open& a, const Open& b) const {
    return a.estimate != b.estimate ? a.estimate > b.estimate : a.cost < b.cost;
  }
};

AStar::AStar(const PassableGrid& grid, AStarParameters parameters)
    : grid_(&grid), parameters_(parameters), nodes_(grid.size()) {}

void AStar::checkEnd(const char* name, CellIndex cell) const {
  if (grid_->passable(cell)) return;
  const std::string place = std::string("the ") + name + " (column " + std::to_string(cell.column) + ", row " +
                            std::to_string(cell.row) + ") ";
  if (grid_->contains(cell)) throw std::invalid_argument(place + "is in a wall, expected a passable cell");
  throw std::invalid_argument(place + "is outside the grid of " + std::to_string(grid_->columns()) + " x " +
                              std::to_string(grid_->rows()) + " cells");
}

void AStar::startSearch() {
  open_.clear();
  most_open_ = 0;
  if (++search_ == 0) {
    std::fill(nodes_.begin(), nodes_.end(), Node{});
    search_ = 1;
  }
}

void AStar::open(CellIndex cell, int direction, MoveCost cost, CellIndex goal) {
  node(cell) = {cost, search_, static_cast<std::uint8_t>(direction), false};
  open_.push_back({cost + estimateCost(parameters_.heuristic, cell, goal, parameters_.costs), cost, cell});
  std::push_heap(open_.begin(), open_.end(), Later{});
  most_open_ = std::max(most_open_, open_.size());
}

void AStar::expand(CellIndex cell, CellIndex goal) {
  const MoveCost cost = node(cell).cost;
  const bool stays_closed = parameters_.closed_cells == ClosedCells::kStayClosed;
  const std::array<bool, kGridMoveCount> possible =
      possibleMoves(passableAround(*grid_, cell), parameters_.corner_cutting);
  for (int direction = 0; direction < kGridMoveCount; direction += parameters_.diagonal_moves ? 1 : 2) {
    if (!possible[static_cast<std::size_t>(direction)]) continue;
    const CellIndex beside = cellBeside(cell, direction);
    const MoveCost cost_beside = cost + (direction % 2 == 0 ? parameters_.costs.straight : parameters_.costs.diagonal);
    const Node& known = node(beside);
    const bool reached = known.search == search_;
    if (reached && (known.cost <= cost_beside || (known.closed && stays_closed))) continue;
    open(beside, direction, cost_beside, goal);
  }
}

GridPath AStar::trace(CellIndex start, CellIndex goal) {
  std::vector<CellIndex> cells = {goal};
  while (cells.back() != start) {
    const CellIndex step = kGridRaySteps[node(cells.back()).direction];
    cells.push_back({cells.back().column - step.column, cells.back().row - step.row});
  }
  std::reverse(cells.begin(), cells.end());
  return pathAlong(std::move(cells));
}

AStarResult AStar::find(CellIndex start, CellIndex goal) {
  checkEnd("start", start);
  checkEnd("goal", goal);
  startSearch();
  AStarResult result;
  open(start, 0, 0, goal);
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), Later{});
    const CellIndex cell = open_.back().cell;
    open_.pop_back();
    if (node(cell).closed) continue;
    node(cell).closed = true;
    ++result.expanded;
    if (cell == goal) {
      result.path = trace(start, goal);
      break;
    }
    expand(cell, goal);
  }
  result.peak_bytes =
      nodes_.size() * sizeof(Node) + most_open_ * sizeof(Open) + result.path.cells.size() * sizeof(CellIndex);
  return result;
}

}  // namespace lstm_planner
