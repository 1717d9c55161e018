#pragma once

#include "grid_world/search/d_star.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"

namespace lstm_planner {

/// Drives through an unknown map with D* (thesis 1.3.2): what it has not sensed it takes for passable, and it plans
/// again when the rays show otherwise. It knows nothing but the map's size, and remembers everything that it has
/// sensed.
class DStarAgent : public GridAgent {
 public:
  /// Of a size that PassableGrid allows.
  DStarAgent(int columns, int rows, CornerCutting corner_cutting = CornerCutting::kForbidden)
      : columns_(columns),
        rows_(rows),
        corner_cutting_(corner_cutting),
        search_(columns, rows, {0, 0}, corner_cutting) {}

  /// Throws std::invalid_argument for a goal outside.
  void start(CellIndex start, CellIndex goal) override {
    search_ = DStar(columns_, rows_, goal, corner_cutting_);
    cell_ = start;
    goal_ = goal;
  }
  /// Every cell of a ray is passable up to its end, and the end is blocked unless the ray reached kGridRayCap.
  void observe(const GridObservation& observation) override {
    cell_ = observation.cell;
    for (int direction = 0; direction < kGridRayCount; ++direction) {
      learnRay(cell_, direction, observation.ranges[static_cast<std::size_t>(direction)]);
    }
  }
  /// kNoPath at the goal, too.
  int decide() override {
    if (cell_ == goal_ || !search_.plan(cell_)) return kNoPath;
    return search_.firstMove(cell_);
  }
  GridLeader leader() const override { return GridLeader::kSearch; }
  std::size_t peakBytes() const override { return search_.peakBytes(); }
  /// States processed by D*.
  std::size_t expandedCells() const override { return search_.processedStates(); }

 private:
  void learnRay(CellIndex cell, int direction, int range) {
    for (int step = 1; step < range; ++step) {
      cell = cellBeside(cell, direction);
      if (search_.contains(cell)) search_.setPassable(cell, true);
    }
    const CellIndex end = cellBeside(cell, direction);
    if (range < kGridRayCap && search_.contains(end)) search_.setPassable(end, false);
  }

  int columns_;
  int rows_;
  CornerCutting corner_cutting_;
  DStar search_;
  CellIndex cell_;
  CellIndex goal_;
};

}  // namespace lstm_planner
