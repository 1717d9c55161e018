#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/grid/passable_grid.hpp"

namespace lstm_planner {

/// Lengths of paths as integers, so that searches compare them without rounding. kStraightCost units are one cell.
using MoveCost = std::int64_t;

/// The ratio of both is a convergent of the continued fraction of sqrt(2), with more than 2^26 in the denominator. No
/// fraction with a smaller denominator lies between it and sqrt(2), so sums of these costs are ordered exactly like the
/// true lengths a + b sqrt(2) on every grid that PassableGrid accepts, and equal only if a and b are. It is the
/// convergent from above: a straight line is never longer than the moves along it.
constexpr MoveCost kStraightCost = 93222358;
constexpr MoveCost kDiagonalCost = 131836323;
static_assert(kDiagonalCost * kDiagonalCost - 2 * kStraightCost * kStraightCost == 1, "a convergent from above");

/// What a search takes moves to cost: c and d of thesis Eq. 1.2-1.4. The lengths of paths do not depend on it.
struct MoveCosts {
  MoveCost straight = kStraightCost;
  MoveCost diagonal = kDiagonalCost;
};

/// The costs for numbers of cells. Throws std::invalid_argument unless 0.01 <= straight <= 100 and straight <= diagonal
/// <= 2 straight: with a higher cost no diagonal move would be used, with a lower one a zigzag of diagonals would
/// cost less than a straight line.
MoveCosts moveCosts(double straight, double diagonal);

constexpr MoveCost moveCost(int direction) { return direction % 2 == 0 ? kStraightCost : kDiagonalCost; }

/// A path through a grid, from its first cell to its last.
struct GridPath {
  std::vector<CellIndex> cells;  ///< start and goal included; empty when there is no path
  std::int64_t straight_moves = 0;
  std::int64_t diagonal_moves = 0;

  bool found() const { return !cells.empty(); }
  double length() const { return lengthOfMoves(straight_moves, diagonal_moves); }  ///< cells
};

/// The path along neighbouring cells.
GridPath pathAlong(std::vector<CellIndex> cells);

}  // namespace lstm_planner
