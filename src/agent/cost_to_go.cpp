#include "lstm_planner/agent/cost_to_go.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "lstm_planner/grid/grid_rays.hpp"

namespace lstm_planner {

namespace {

/// Cells round an obstacle that cheapestThrough() can look at.
constexpr int kFarthestReach = 12;

int stepLength(int direction) { return direction % 2 != 0 ? CostToGo::kDiagonal : CostToGo::kStraight; }

int opposite(int direction) { return direction ^ 4; }

int toNeighbour(int direction, int side) {
  const CellIndex& step = kGridRaySteps[static_cast<std::size_t>(direction)];
  return step.row * side + step.column;
}

}  // namespace

CostToGo::CostToGo(double tightness) {
  const auto tight = static_cast<int>(std::lround(tightness * 2.0));
  const auto narrow = static_cast<int>(std::lround((1.0 + 0.25 * (tightness - 1.0)) * 2.0));
  factors_[static_cast<int>(ObstacleMemory::Passage::kBlocked)] = tight;  // never entered
  factors_[static_cast<int>(ObstacleMemory::Passage::kTight)] = tight;
  factors_[static_cast<int>(ObstacleMemory::Passage::kNarrow)] = narrow;
  factors_[static_cast<int>(ObstacleMemory::Passage::kRoomy)] = 2;
}

std::uint32_t CostToGo::octile(int columns, int rows) {
  const int longer = std::max(std::abs(columns), std::abs(rows));
  const int shorter = std::min(std::abs(columns), std::abs(rows));
  return static_cast<std::uint32_t>(kStraight * (longer - shorter) + kDiagonal * shorter);
}

std::uint32_t CostToGo::octileBetween(int from, int to) const {
  return octile(from % side_ - to % side_, from / side_ - to / side_);
}

bool CostToGo::search(ObstacleMemory& memory, int start, const std::vector<End>& ends, std::uint32_t margin) {
  clear(memory.side());
  start_ = start;
  start_column_ = start % side_;
  start_row_ = start / side_;
  base_ = kNone;
  for (const End& end : ends) {
    base_ = std::min(base_, end.cost);
  }
  std::uint32_t lowest = kNone;
  for (const End& end : ends) {
    lowest = std::min(lowest, end.cost - base_ + octileBetween(end.cell, start));
  }
  open_.clear(lowest);
  for (const End& end : ends) {
    reach(end.cell % side_, end.cell / side_, end.cost - base_);
  }
  return run(memory, start, margin);
}

bool CostToGo::extendTo(ObstacleMemory& memory, int cell) { return isKnown(cell) || run(memory, cell, 0); }

void CostToGo::clear(int side) {
  if (side != side_) {
    side_ = side;
    costs_.assign(index(side) * index(side), kFar);
    touched_.assign(index(side), {kFar, 0});
    return;
  }
  for (int row = 0; row < side_; ++row) {
    Span& span = touched_[index(row)];
    if (span.first <= span.last) {
      const auto begin = costs_.begin() + row * side_;
      std::fill(begin + span.first, begin + span.last + 1, kFar);
    }
    span = {kFar, 0};
  }
}

bool CostToGo::run(ObstacleMemory& memory, int target, std::uint32_t margin) {
  std::uint32_t limit = kNone;
  std::uint32_t lowest = 0;
  bool more = open_.lowest(&lowest);
  for (; more && lowest <= limit; more = open_.lowest(&lowest)) {
    std::uint16_t column = 0;
    std::uint16_t row = 0;
    open_.pop(&column, &row);
    const int cell = row * side_ + column;
    const std::uint32_t cost = costs_[index(cell)];
    if (lowest != cost + octile(start_column_ - column, start_row_ - row)) {
      continue;  // a cheaper way from it was found meanwhile
    }
    expand(memory, column, row, cost);
    if (cell == target) {
      limit = lowest + margin;
    }
  }
  searched_to_ = more ? lowest - 1 : kNone - 1;
  return isKnown(target);
}

void CostToGo::expand(ObstacleMemory& memory, int column, int row, std::uint32_t cost) {
  const int cell = row * side_ + column;
  const std::uint8_t entered_from = entries(memory, cell);
  const int factor = factors_[static_cast<int>(memory.passage(cell))];
  const auto straight = cost + static_cast<std::uint32_t>(kStraight * factor / 2);
  const auto diagonal = cost + static_cast<std::uint32_t>(kDiagonal * factor / 2);
  for (int direction = 0; direction < kGridRayCount; ++direction) {
    if ((entered_from >> direction & 1) != 0) {
      const CellIndex& step = kGridRaySteps[static_cast<std::size_t>(direction)];
      reach(column + step.column, row + step.row, direction % 2 != 0 ? diagonal : straight);
    }
  }
}

void CostToGo::reach(int column, int row, std::uint32_t cost) {
  std::uint16_t& known = costs_[index(row * side_ + column)];
  if (cost < known) {
    known = static_cast<std::uint16_t>(cost);
    Span& span = touched_[index(row)];
    span.first = std::min(span.first, static_cast<std::uint16_t>(column));
    span.last = std::max(span.last, static_cast<std::uint16_t>(column));
    open_.push(cost + octile(start_column_ - column, start_row_ - row), static_cast<std::uint16_t>(column),
               static_cast<std::uint16_t>(row));
  }
}

bool CostToGo::isAtBorder(int cell) const {
  const int column = cell % side_;
  return column == 0 || column == side_ - 1 || cell < side_ || cell >= side_ * (side_ - 1);
}

/// From which of its neighbours the footprint can come: ways lead both ways, but the memory tells no exits of cells at
/// the border.
std::uint8_t CostToGo::entries(ObstacleMemory& memory, int cell) const {
  if (!isAtBorder(cell)) {
    return memory.exits(cell);
  }
  const int column = cell % side_;
  const int row = cell / side_;
  std::uint8_t entries = 0;
  for (int direction = 0; direction < kGridRayCount; ++direction) {
    const CellIndex& step = kGridRaySteps[static_cast<std::size_t>(direction)];
    const bool inside = column + step.column >= 0 && column + step.column < side_ && row + step.row >= 0 &&
                        row + step.row < side_;
    if (inside && (memory.exits(cell + toNeighbour(direction, side_)) >> opposite(direction) & 1) != 0) {
      entries = static_cast<std::uint8_t>(entries | 1 << direction);
    }
  }
  return entries;
}

std::uint32_t CostToGo::cost(int cell) const {
  const std::uint32_t relative = relativeCost(cell);
  return relative == kNone ? kNone : base_ + relative;
}

std::uint32_t CostToGo::relativeCost(int cell) const {
  const std::uint32_t known = costs_[index(cell)] == kFar ? kNone : costs_[index(cell)];
  if (searched_to_ >= kNone - 1) {
    return known;
  }
  // What was not looked at yet has a larger estimate than all that was.
  const std::uint32_t least = searched_to_ + 1;
  return std::min(known, least - std::min(least, octileBetween(cell, start_)));
}

int CostToGo::next(ObstacleMemory& memory, int cell, int column, int row) const {
  if (isAtBorder(cell)) {
    return -1;
  }
  const int cost = costs_[index(cell)];
  const int columns = column - cell % side_;
  const int rows = row - cell / side_;
  int next = -1;
  int nearest = std::numeric_limits<int>::max();
  for (int direction = 0; direction < kGridRayCount; ++direction) {
    const CellIndex& way = kGridRaySteps[index(direction)];
    const int distance = (columns - way.column) * (columns - way.column) + (rows - way.row) * (rows - way.row);
    const int neighbour = cell + toNeighbour(direction, side_);
    const int step = cost - costs_[index(neighbour)];
    if (distance < nearest && step > 0 &&
        step == stepLength(direction) * factors_[static_cast<int>(memory.passage(neighbour))] / 2 &&
        (entries(memory, neighbour) >> opposite(direction) & 1) != 0) {
      nearest = distance;
      next = neighbour;
    }
  }
  return next;
}

std::uint32_t CostToGo::cheapestThrough(ObstacleMemory& memory, int freed, int reach, int from,
                                        std::uint32_t enough) const {
  if (reach > kFarthestReach) {
    return 0;
  }
  constexpr int kWidest = 2 * kFarthestReach + 3;
  std::array<std::uint32_t, kWidest * kWidest> costs;
  const int first_column = std::max(0, freed % side_ - reach - 1);
  const int last_column = std::min(side_ - 1, freed % side_ + reach + 1);
  const int first_row = std::max(0, freed / side_ - reach - 1);
  const int last_row = std::min(side_ - 1, freed / side_ + reach + 1);
  const auto at = [&](int column, int row) -> std::uint32_t& {
    return costs[index((row - first_row) * kWidest + column - first_column)];
  };
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      at(column, row) = relativeCost(row * side_ + column);
    }
  }
  const int from_column = from % side_;
  const int from_row = from / side_;
  std::uint32_t cheapest = kNone;
  for (int row = first_row + 1; row < last_row; ++row) {
    for (int column = first_column + 1; column < last_column; ++column) {
      std::uint32_t after = kNone;
      for (int r = row - 1; r <= row + 1; ++r) {
        after = std::min({after, at(column - 1, r), at(column, r), at(column + 1, r)});
      }
      if (after == kNone) {
        continue;
      }
      const std::uint32_t before = base_ + octile(from_column - column, from_row - row);
      const int cell = row * side_ + column;
      std::uint32_t through = before + kStraight + after;
      if (through < enough) {
        const std::uint8_t exits = memory.exits(cell);
        std::uint32_t best = kNone;
        for (int direction = 0; direction < kGridRayCount; ++direction) {
          const CellIndex& step = kGridRaySteps[index(direction)];
          const std::uint32_t rest = at(column + step.column, row + step.row);
          if ((exits >> direction & 1) != 0 && rest != kNone) {
            const int factor =
                factors_[static_cast<int>(memory.passage(cell + toNeighbour(direction, side_)))];
            best = std::min(best, rest + static_cast<std::uint32_t>(stepLength(direction) * factor / 2));
          }
        }
        if (best >= at(column, row)) {
          continue;  // no cheaper than it was, or there is no way
        }
        through = before + best;
      }
      cheapest = std::min(cheapest, through);
    }
  }
  return cheapest;
}

}  // namespace lstm_planner
