#include "lstm_planner/drive/local_map/cost_to_go.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "lstm_planner/grid/grid_rays.hpp"

namespace lstm_planner {
namespace {

int opposite(int direction) { return direction ^ 4; }

/// Cells round an obstacle that cheapestThrough() can look at.
constexpr int kFarthestReach = 12;

}  // namespace

CostToGo::CostToGo(double tightness) {
  const auto tight = static_cast<int>(std::lround(tightness * 2.0));
  const auto narrow = static_cast<int>(std::lround((1.0 + 0.25 * (tightness - 1.0)) * 2.0));
  factors_[static_cast<int>(LocalMap::Passage::kBlocked)] = tight;  // never entered
  factors_[static_cast<int>(LocalMap::Passage::kTight)] = tight;
  factors_[static_cast<int>(LocalMap::Passage::kNarrow)] = narrow;
  factors_[static_cast<int>(LocalMap::Passage::kRoomy)] = 2;
}

std::uint32_t CostToGo::octile(int columns, int rows) {
  return static_cast<std::uint32_t>(octileFifths(columns, rows));
}

std::uint32_t CostToGo::octileBetween(int from, int to) const {
  return octile(from % side_ - to % side_, from / side_ - to / side_);
}

bool CostToGo::search(LocalMap& memory, int start, const std::vector<End>& ends, int column, int row) {
  clear(memory.side());
  start_ = start;
  start_column_ = start % side_;
  start_row_ = start / side_;
  bool found = searchOnce(memory, ends);
  if (!found && overflowed_) {  // some path costs more than 16 bits tell
    clear(memory.side());
    wide_costs_.resize(costs_.size(), kNone);
    is_wide_ = true;
    found = searchOnce(memory, ends);
  }
  trace(memory, start, column, row);
  return found;
}

bool CostToGo::searchOnce(LocalMap& memory, const std::vector<End>& ends) {
  base_ = kNone;
  for (const End& end : ends) {
    base_ = std::min(base_, end.cost);
  }
  std::uint32_t lowest = kNone;
  for (const End& end : ends) {
    lowest = std::min(lowest, end.cost - base_ + octileBetween(end.cell, start_));
  }
  open_.clear(lowest);
  for (const End& end : ends) {
    reach(end.cell % side_, end.cell / side_, end.cost - base_);
  }
  return run(memory, start_);
}

bool CostToGo::traceFrom(LocalMap& memory, int start, int column, int row) {
  if (left(start) == kNone) {
    return false;
  }
  trace(memory, start, column, row);
  return left(path_.back()) == 0 || isAtBorder(path_.back());
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
    wide_costs_.clear();
    costs_.assign(index(side) * index(side), kFar);
    touched_.assign(index(side), {kFar, 0});
    path_.reserve(2 * index(side));
  } else if (is_wide_) {
    forgetTouched(kNone, &wide_costs_);
  } else {
    forgetTouched(kFar, &costs_);
  }
  is_wide_ = false;
  overflowed_ = false;
}

template <typename Cost>
void CostToGo::forgetTouched(Cost unknown, std::vector<Cost>* costs) {
  for (int row = 0; row < side_; ++row) {
    Span& span = touched_[index(row)];
    if (span.first <= span.last) {
      const auto begin = costs->begin() + row * side_;
      std::fill(begin + span.first, begin + span.last + 1, unknown);
    }
    span = {kFar, 0};
  }
}

bool CostToGo::run(LocalMap& memory, int target) {
  bool found = false;
  std::uint32_t lowest = 0;
  bool more = open_.lowest(&lowest);
  for (; more && !found; more = open_.lowest(&lowest)) {
    std::uint16_t column = 0;
    std::uint16_t row = 0;
    open_.pop(&column, &row);
    const int cell = row * side_ + column;
    const std::uint32_t cost = left(cell);
    if (lowest != cost + octile(start_column_ - column, start_row_ - row)) {
      continue;  // a cheaper path from it was found meanwhile
    }
    found = cell == target;
    expand(memory, column, row, cost);
  }
  searched_to_ = more ? lowest - 1 : kNone - 1;
  if (overflowed_) {
    searched_to_ = std::min<std::uint32_t>(searched_to_, kFar - 1);  // what was left out has a larger estimate
  }
  forgetOpen();
  return found;
}

/// What was come to but not looked at may turn out to be nearer.
void CostToGo::forgetOpen() {
  for (std::uint32_t estimate = 0; open_.lowest(&estimate);) {
    std::uint16_t column = 0;
    std::uint16_t row = 0;
    open_.pop(&column, &row);
    const int cell = row * side_ + column;
    if (estimate == left(cell) + octile(start_column_ - column, start_row_ - row)) {
      setLeft(index(cell), kNone);
    }
  }
}

void CostToGo::expand(LocalMap& memory, int column, int row, std::uint32_t cost) {
  const int cell = row * side_ + column;
  const std::uint8_t entered_from = entries(memory, cell);
  const int factor = factors_[static_cast<int>(memory.passage(cell))];
  const auto straight = cost + static_cast<std::uint32_t>(kStraightFifths * factor / 2);
  const auto diagonal = cost + static_cast<std::uint32_t>(kDiagonalFifths * factor / 2);
  for (int direction = 0; direction < kGridRayCount; ++direction) {
    if ((entered_from >> direction & 1) != 0) {
      const CellIndex& step = kGridRaySteps[static_cast<std::size_t>(direction)];
      reach(column + step.column, row + step.row, direction % 2 != 0 ? diagonal : straight);
    }
  }
}

void CostToGo::reach(int column, int row, std::uint32_t cost) {
  const std::size_t cell = index(row * side_ + column);
  if (cost < (is_wide_ ? wide_costs_[cell] : costs_[cell])) {
    setLeft(cell, cost);
    Span& span = touched_[index(row)];
    span.first = std::min(span.first, static_cast<std::uint16_t>(column));
    span.last = std::max(span.last, static_cast<std::uint16_t>(column));
    open_.push(cost + octile(start_column_ - column, start_row_ - row), static_cast<std::uint16_t>(column),
               static_cast<std::uint16_t>(row));
  } else if (cost >= kFar && !is_wide_) {
    overflowed_ = true;
  }
}

bool CostToGo::isAtBorder(int cell) const {
  const int column = cell % side_;
  return column == 0 || column == side_ - 1 || cell < side_ || cell >= side_ * (side_ - 1);
}

/// From which of its neighbours the footprint can come: paths lead both ways, but the memory tells no exits of cells at
/// the border.
std::uint8_t CostToGo::entries(LocalMap& memory, int cell) const {
  if (!isAtBorder(cell)) {
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
  if (isAtBorder(cell)) {
    return -1;
  }
  const std::uint32_t cost = left(cell);
  const std::int64_t columns = column - cell % side_;  // their squares need more than 32 bits from 9.3 km on
  const std::int64_t rows = row - cell / side_;
  int next = -1;
  std::int64_t nearest = std::numeric_limits<std::int64_t>::max();
  for (int direction = 0; direction < kGridRayCount; ++direction) {
    const CellIndex& step = kGridRaySteps[index(direction)];
    const std::int64_t distance =
        (columns - step.column) * (columns - step.column) + (rows - step.row) * (rows - step.row);
    const int neighbour = neighbourOf(cell, direction);
    const std::uint32_t rest = left(neighbour);
    if (distance < nearest && rest < cost && cost - rest == stepCost(memory, neighbour, direction) &&
        (entries(memory, neighbour) >> opposite(direction) & 1) != 0) {
      nearest = distance;
      next = neighbour;
    }
  }
  return next;
}

std::uint32_t CostToGo::cost(int cell) const {
  const std::uint32_t relative = relativeCost(cell % side_, cell / side_);
  return relative == kNone ? kNone : base_ + relative;
}

std::uint32_t CostToGo::relativeCost(int column, int row) const {
  const std::uint32_t known = left(row * side_ + column);
  if (known != kNone) {
    return known;
  }
  if (searched_to_ >= kNone - 1) {
    return kNone;
  }
  // What was not looked at has a larger estimate than all that was.
  const std::uint32_t least = searched_to_ + 1;
  return least - std::min(least, octile(start_column_ - column, start_row_ - row));
}

std::uint32_t CostToGo::cheapestThrough(LocalMap& memory, int freed, int reach, int from, std::uint32_t enough) const {
  if (reach > kFarthestReach) {
    return 0;
  }
  const int first_column = std::max(1, freed % side_ - reach);
  const int last_column = std::min(side_ - 2, freed % side_ + reach);
  const int first_row = std::max(1, freed / side_ - reach);
  const int last_row = std::min(side_ - 2, freed / side_ + reach);
  constexpr int kWidest = 2 * kFarthestReach + 3;
  // Of each cell and the two beside it in its row: what is left from the cheapest of them.
  std::array<std::array<std::uint32_t, kWidest>, kWidest> beside;
  for (int row = first_row - 1; row <= last_row + 1; ++row) {
    std::uint32_t before = relativeCost(first_column - 1, row);
    std::uint32_t here = relativeCost(first_column, row);
    for (int column = first_column; column <= last_column; ++column) {
      const std::uint32_t after = relativeCost(column + 1, row);
      beside[index(row - first_row + 1)][index(column - first_column)] = std::min({before, here, after});
      before = here;
      here = after;
    }
  }
  std::uint32_t cheapest = kNone;
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const auto i = index(row - first_row);
      const auto j = index(column - first_column);
      const std::uint32_t rest = std::min({beside[i][j], beside[i + 1][j], beside[i + 2][j]});
      if (rest == kNone) {
        continue;
      }
      const std::uint32_t before = base_ + octile(from % side_ - column, from / side_ - row);
      std::uint32_t through = before + kStraightFifths + rest;
      if (through < enough) {
        const std::uint32_t cost = costBySteps(memory, column, row);
        if (cost >= relativeCost(column, row)) {
          continue;  // no cheaper than it was, or there is no path
        }
        through = before + cost;
      }
      cheapest = std::min(cheapest, through);
    }
  }
  return cheapest;
}

/// What the path from a cell costs at least by what is left from its neighbours, and the steps to them as they are now.
std::uint32_t CostToGo::costBySteps(LocalMap& memory, int column, int row) const {
  const int cell = row * side_ + column;
  const std::uint8_t exits = memory.exits(cell);
  std::uint32_t cost = kNone;
  for (int direction = 0; direction < kGridRayCount; ++direction) {
    const CellIndex& step = kGridRaySteps[index(direction)];
    const std::uint32_t rest = relativeCost(column + step.column, row + step.row);
    if ((exits >> direction & 1) != 0 && rest != kNone) {
      cost = std::min(cost, rest + stepCost(memory, neighbourOf(cell, direction), direction));
    }
  }
  return cost;
}

}  // namespace lstm_planner
