#include "lstm_planner/drive/local_map/cost_to_go.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "lstm_planner/grid/grid_rays.hpp"

namespace lstm_planner {

CostToGo::CostToGo(double tightness) {
  const auto tight = static_cast<int>(std::lround(tightness * 2.0));
  const auto narrow = static_cast<int>(std::lround(narrowness(tightness) * 2.0));
  factors_[static_cast<int>(LocalMap::Passage::kBlocked)] = tight;  // never entered
  factors_[static_cast<int>(LocalMap::Passage::kTight)] = tight;
  factors_[static_cast<int>(LocalMap::Passage::kNarrow)] = narrow;
  factors_[static_cast<int>(LocalMap::Passage::kRoomy)] = 2;
}

std::uint32_t CostToGo::octile(int columns, int rows) {
  return static_cast<std::uint32_t>(octileFifths(columns, rows));
}

bool CostToGo::search(LocalMap& memory, int start, const std::vector<End>& ends, int column, int row) {
  clear(memory.side());
  start_column_ = start % side_;
  start_row_ = start / side_;
  std::uint32_t lowest = kNone;
  for (const End& end : ends) lowest = std::min(lowest, estimate(end.cell % side_, end.cell / side_, end.cost));
  open_.clear(lowest);
  for (const End& end : ends) reach(end.cell % side_, end.cell / side_, end.cost);
  return searchOn(memory, start, column, row);
}

bool CostToGo::searchOn(LocalMap& memory, int start, int column, int row) {
  if (!runTo(memory, start)) return false;
  trace(memory, start, column, row);
  return true;
}

void CostToGo::trace(LocalMap& memory, int start, int column, int row) {
  path_.clear();
  for (int cell = start; cell >= 0; cell = next(memory, cell, column, row)) {
    path_.push_back(cell);
  }
}

void CostToGo::clear(int side) {
  if (side != side_) {
    side_ = side;
    costs_.assign(index(side) * index(side), kNone);
    touched_.assign(index(side), {side, -1});
    path_.reserve(2 * index(side));
    return;
  }
  for (int row = 0; row < side_; ++row) {
    Span& span = touched_[index(row)];
    const auto begin = costs_.begin() + row * side_;
    if (span.first <= span.last) std::fill(begin + span.first, begin + span.last + 1, kNone);
    span = {side, -1};
  }
}

/// Goes on with the search until the cheapest path from the target is known.
bool CostToGo::runTo(LocalMap& memory, int target) {
  for (std::uint32_t lowest = 0; open_.lowest(&lowest);) {
    if (isSettled(target, lowest)) return true;
    std::uint16_t column = 0;
    std::uint16_t row = 0;
    open_.pop(&column, &row);
    const std::uint32_t cost = costs_[index(row * side_ + column)];
    // Otherwise a cheaper path from it was found meanwhile.
    if (lowest == estimate(column, row, cost)) expand(memory, column, row, cost);
  }
  return costs_[index(target)] != kNone;
}

/// All that may still be found has an estimate of at least `lowest`, so no cheaper path from the cell.
bool CostToGo::isSettled(int cell, std::uint32_t lowest) const {
  const std::uint32_t cost = costs_[index(cell)];
  return cost != kNone && estimate(cell % side_, cell / side_, cost) <= lowest;
}

/// Of a path from the start through a cell.
std::uint32_t CostToGo::estimate(int column, int row, std::uint32_t cost) const {
  return cost + octile(start_column_ - column, start_row_ - row);
}

void CostToGo::expand(LocalMap& memory, int column, int row, std::uint32_t cost) {
  const int cell = row * side_ + column;
  const std::uint8_t entered_from = entries(memory, cell);
  const int factor = factors_[static_cast<int>(memory.passage(cell))];
  const auto straight = cost + static_cast<std::uint32_t>(kStraightFifths * factor / 2);
  const auto diagonal = cost + static_cast<std::uint32_t>(kDiagonalFifths * factor / 2);
  for (int direction = 0; direction < kGridRayCount; ++direction) {
    if ((entered_from >> direction & 1) == 0) continue;
    const CellIndex& step = kGridRaySteps[index(direction)];
    const int from_column = column + step.column;
    const int from_row = row + step.row;
    // Paths end at the border: what lies beyond is not known.
    const bool is_inside = from_column > 0 && from_column < side_ - 1 && from_row > 0 && from_row < side_ - 1;
    if (is_inside) reach(from_column, from_row, direction % 2 != 0 ? diagonal : straight);
  }
}

void CostToGo::reach(int column, int row, std::uint32_t cost) {
  std::uint32_t& known = costs_[index(row * side_ + column)];
  if (cost >= known) return;
  known = cost;
  Span& span = touched_[index(row)];
  span.first = std::min(span.first, column);
  span.last = std::max(span.last, column);
  open_.push(estimate(column, row, cost), static_cast<std::uint16_t>(column), static_cast<std::uint16_t>(row));
}

/// From which of its neighbours the footprint can come: paths lead both ways, but the memory tells no exits of cells at
/// the border.
std::uint8_t CostToGo::entries(LocalMap& memory, int cell) const {
  if (!memory.isAtBorder(cell)) {
    return memory.exits(cell);
  }
  const int column = cell % side_;
  const int row = cell / side_;
  std::uint8_t entries = 0;
  for (int direction = 0; direction < kGridRayCount; ++direction) {
    const CellIndex& step = kGridRaySteps[static_cast<std::size_t>(direction)];
    const bool inside =
        column + step.column >= 0 && column + step.column < side_ && row + step.row >= 0 && row + step.row < side_;
    if (inside && (memory.exits(neighbourOf(cell, direction)) >> opposite(direction) & 1) != 0) {
      entries = static_cast<std::uint8_t>(entries | 1 << direction);
    }
  }
  return entries;
}

int CostToGo::neighbourOf(int cell, int direction) const {
  const CellIndex& step = kGridRaySteps[index(direction)];
  return cell + step.row * side_ + step.column;
}

std::uint32_t CostToGo::stepCost(LocalMap& memory, int to, int direction) const {
  const int length = direction % 2 != 0 ? kDiagonalFifths : kStraightFifths;
  return static_cast<std::uint32_t>(length * factors_[static_cast<int>(memory.passage(to))] / 2);
}

int CostToGo::next(LocalMap& memory, int cell, int column, int row) const {
  if (memory.isAtBorder(cell)) {
    return -1;
  }
  const std::uint32_t cost = costs_[index(cell)];
  const std::int64_t columns = column - cell % side_;  // their squares need more than 32 bits from 9.3 km on
  const std::int64_t rows = row - cell / side_;
  int next = -1;
  std::int64_t nearest = std::numeric_limits<std::int64_t>::max();
  for (int direction = 0; direction < kGridRayCount; ++direction) {
    const CellIndex& step = kGridRaySteps[index(direction)];
    const std::int64_t distance =
        (columns - step.column) * (columns - step.column) + (rows - step.row) * (rows - step.row);
    const int neighbour = neighbourOf(cell, direction);
    const std::uint32_t rest = costs_[index(neighbour)];
    if (distance < nearest && rest < cost && cost - rest == stepCost(memory, neighbour, direction) &&
        (entries(memory, neighbour) >> opposite(direction) & 1) != 0) {
      nearest = distance;
      next = neighbour;
    }
  }
  return next;
}

}  // namespace lstm_planner
