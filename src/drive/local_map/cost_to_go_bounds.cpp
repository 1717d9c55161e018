// What a search tells after something has changed; the search is in cost_to_go.cpp.

#include <algorithm>
#include <array>

#include "lstm_planner/drive/local_map/cost_to_go.hpp"
#include "lstm_planner/grid/grid_rays.hpp"

namespace lstm_planner {

namespace {

/// Cells round an obstacle that cheapestThrough() can look at.
constexpr int kFarthestReach = 12;

}  // namespace

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
