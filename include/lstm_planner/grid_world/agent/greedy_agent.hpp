#pragma once

#include "lstm_planner/grid_world/agent/grid_agent.hpp"

namespace lstm_planner {

/// Makes the possible move that brings it nearest to the goal by octile distance, of equally near ones the one that
/// comes first in kGridRaySteps. Remembers nothing, so it walks to and fro in front of the first obstacle that is not
/// convex: what an agent is worth is how much better than this it does.
class GreedyAgent : public GridAgent {
 public:
  explicit GreedyAgent(CornerCutting corner_cutting = CornerCutting::kForbidden) : corner_cutting_(corner_cutting) {}

  void start(CellIndex start, CellIndex goal) override { observation_ = {start, goal, {}}; }
  void observe(const GridObservation& observation) override { observation_ = observation; }
  /// kNoPath when no move is possible.
  int decide() override;
  GridLeader leader() const override { return GridLeader::kGreedy; }
  std::size_t peakBytes() const override { return sizeof(*this); }

 private:
  CornerCutting corner_cutting_;
  GridObservation observation_;
};

}  // namespace lstm_planner
