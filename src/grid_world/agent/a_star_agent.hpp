#pragma once

#include <algorithm>
#include <utility>

#include "grid_world/search/a_star.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"

namespace lstm_planner {

/// Walks the path that A* finds on the whole map before the first step: the offline agent of the thesis (1.3.1), the
/// yardstick of the others. It ignores what is sensed.
class AStarAgent : public GridAgent {
 public:
  /// `grid` must stay where it is and must not change its size.
  explicit AStarAgent(const PassableGrid& grid, AStarParameters parameters = {})
      : grid_(&grid), search_(grid, parameters) {}

  /// Throws std::invalid_argument when start or goal is outside or not passable.
  void start(CellIndex start, CellIndex goal) override {
    goal_ = goal;
    expanded_ = 0;
    peak_bytes_ = 0;
    plan(start);
  }
  /// Plans again when the agent is not where its path led it.
  void observe(const GridObservation& observation) override {
    if (!path_.found() || path_.cells[place_] == observation.cell) return;
    const bool went_on = place_ + 1 < path_.cells.size() && path_.cells[place_ + 1] == observation.cell;
    if (went_on) {
      ++place_;
    } else {
      plan(observation.cell);
    }
  }
  /// kNoPath at the goal, too.
  int decide() override {
    if (place_ + 1 >= path_.cells.size()) return kNoPath;
    return rayBetween(path_.cells[place_], path_.cells[place_ + 1]);
  }
  GridLeader leader() const override { return GridLeader::kSearch; }
  /// The search's nodes and lists, the path, and the map, without which it could not search.
  std::size_t peakBytes() const override { return peak_bytes_; }
  std::size_t expandedCells() const override { return expanded_; }

 private:
  void plan(CellIndex start) {
    AStarResult result = search_.find(start, goal_);
    path_ = std::move(result.path);
    place_ = 0;
    expanded_ += result.expanded;
    peak_bytes_ = std::max(peak_bytes_, result.peak_bytes + grid_->size());
  }

  const PassableGrid* grid_;
  AStar search_;
  CellIndex goal_;
  GridPath path_;
  std::size_t place_ = 0;  ///< in the path
  std::size_t expanded_ = 0;
  std::size_t peak_bytes_ = 0;
};

}  // namespace lstm_planner
