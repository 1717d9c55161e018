#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "lstm_planner/grid_world/agent/grid_agent.hpp"
#include "lstm_planner/grid_world/world/range_table.hpp"

namespace lstm_planner {

/// Where an agent is on its path through a map, and what it senses there.
class GridWalk {
 public:
  /// Nowhere.
  GridWalk() = default;
  /// `ranges` must outlive it.
  GridWalk(const RangeTable& ranges, CellIndex start, CellIndex goal) : ranges_(&ranges), cell_(start), goal_(goal) {}

  CellIndex cell() const { return cell_; }
  GridObservation observe() const { return {cell_, goal_, ranges_->at(cell_)}; }
  /// Within one cell of the goal, along rows and columns.
  bool hasArrived() const {
    return std::max(std::abs(goal_.column - cell_.column), std::abs(goal_.row - cell_.row)) <= 1;
  }

  void move(int direction) {
    cell_ = cellBeside(cell_, direction);
    ++(direction % 2 == 0 ? straight_moves_ : diagonal_moves_);
  }
  std::int64_t straightMoves() const { return straight_moves_; }
  std::int64_t diagonalMoves() const { return diagonal_moves_; }
  std::int64_t moves() const { return straight_moves_ + diagonal_moves_; }

 private:
  const RangeTable* ranges_ = nullptr;
  CellIndex cell_;
  CellIndex goal_;
  std::int64_t straight_moves_ = 0;
  std::int64_t diagonal_moves_ = 0;
};

}  // namespace lstm_planner
