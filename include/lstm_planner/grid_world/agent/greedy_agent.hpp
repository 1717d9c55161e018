#pragma once

#include "lstm_planner/grid_world/agent/grid_agent.hpp"
#include "lstm_planner/grid_world/search/exact_octile.hpp"

namespace lstm_planner {

/// Takes the possible move whose end is nearest to the goal by octile distance; of equally near ones the first in
/// kGridRaySteps. It remembers nothing, so it walks back and forth in front of the first obstacle that is not convex.
/// This is the baseline for other agents.
class GreedyAgent : public GridAgent {
 public:
  explicit GreedyAgent(CornerCutting corner_cutting = CornerCutting::kForbidden) : corner_cutting_(corner_cutting) {}

  void start(CellIndex start, CellIndex goal) override { observation_ = {start, goal, {}}; }
  void observe(const GridObservation& observation) override { observation_ = observation; }
  /// kNoPath when no move is possible.
  int decide() override {
    int best = kNoPath;
    OctileDistance best_distance;
    for (int direction = 0; direction < kGridMoveCount; ++direction) {
      if (!movePossible(observation_.ranges, direction, corner_cutting_)) continue;
      const OctileDistance distance = octileDistance(cellBeside(observation_.cell, direction), observation_.goal);
      if (best == kNoPath || distance < best_distance) {
        best = direction;
        best_distance = distance;
      }
    }
    return best;
  }
  GridLeader leader() const override { return GridLeader::kGreedy; }
  std::size_t peakBytes() const override { return sizeof(*this); }

 private:
  CornerCutting corner_cutting_;
  GridObservation observation_;
};

}  // namespace lstm_planner
