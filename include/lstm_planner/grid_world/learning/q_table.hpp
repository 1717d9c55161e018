#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid/passable_grid.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"

namespace lstm_planner {

/// How the table learns.
struct QTableParameters {
  double learning_rate = 0.5;  ///< alpha, in (0, 1]; 1 forgets the old value, which is right if nothing is random
  double discount = 1.0;       ///< gamma, in (0, 1]
  double exploration = 0.1;    ///< share of moves at random (epsilon), in [0, 1]
  int max_steps = 1000;        ///< of an episode
  CornerCutting corner_cutting = CornerCutting::kForbidden;
};
/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const QTableParameters& parameters);

/// Q-learning with a table (thesis Eq. 2.34, 2.35, 2.37): one value for each passable cell and move of one map, for one
/// goal. The reward of a move is its negative length, so that with a discount of 1 the values become the negative
/// lengths of the shortest paths that begin with the move. Values start at 0, which is better than all others, so that
/// each move is tried. Only moves that are possible have a value.
class QTable {
 public:
  /// Throws as validate(), and std::invalid_argument for a goal that is blocked or outside. `grid` must outlive the
  /// table.
  QTable(const QTableParameters& parameters, const PassableGrid& grid, CellIndex goal);

  /// Walks from `start`, which must be passable, to the goal or for max_steps, and learns from each move. Returns the
  /// number of moves.
  int runEpisode(CellIndex start, Random& random);

  /// The move with the highest value (Eq. 2.37), of equal ones the first. kNoPath if no move is possible.
  int bestMove(CellIndex cell) const;

  /// The highest value of the cell's moves (Eq. 2.34); 0 at the goal.
  double value(CellIndex cell) const;

  const PassableGrid& grid() const { return grid_; }
  CellIndex goal() const { return goal_; }
  std::int64_t steps() const { return steps_; }  ///< of all episodes
  std::size_t bytes() const { return values_.size() * sizeof(values_[0]); }

 private:
  using Values = std::array<float, kGridMoveCount>;  ///< negative infinity for moves that are not possible

  const Values& valuesOf(CellIndex cell) const { return values_[grid_.offset(cell)]; }
  int drawMove(CellIndex cell, Random& random) const;

  QTableParameters parameters_;
  const PassableGrid& grid_;
  CellIndex goal_;
  std::vector<Values> values_;
  std::int64_t steps_ = 0;
};

/// Takes the moves of a table, which must outlive the agent; also if it is given another goal than the table's.
class QTableAgent : public GridAgent {
 public:
  explicit QTableAgent(const QTable& table) : table_(table) {}

  void start(CellIndex start, CellIndex /*goal*/) override { cell_ = start; }
  void observe(const GridObservation& observation) override { cell_ = observation.cell; }
  int decide() override { return table_.bestMove(cell_); }
  GridLeader leader() const override { return GridLeader::kGreedy; }
  std::size_t peakBytes() const override { return sizeof(*this) + table_.bytes(); }

 private:
  const QTable& table_;
  CellIndex cell_;
};

}  // namespace lstm_planner
