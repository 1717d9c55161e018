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
  DStarAgent(int columns, int rows, CornerCutting corner_cutting = CornerCutting::kForbidden);

  /// Throws std::invalid_argument for a goal outside.
  void start(CellIndex start, CellIndex goal) override;
  /// Every cell of a ray is passable up to its end, and the end is blocked unless the ray reached kGridRayCap.
  void observe(const GridObservation& observation) override;
  /// kNoPath at the goal, too.
  int decide() override;
  GridLeader leader() const override { return GridLeader::kSearch; }
  std::size_t peakBytes() const override { return search_.peakBytes(); }
  /// States processed by D*.
  std::size_t expandedCells() const override { return search_.processedStates(); }

 private:
  void learnRay(CellIndex cell, int direction, int range);

  int columns_;
  int rows_;
  CornerCutting corner_cutting_;
  DStar search_;
  CellIndex cell_;
  CellIndex goal_;
};

}  // namespace lstm_planner
