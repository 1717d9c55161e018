#pragma once

#include "lstm_planner/grid_world/agent/rolling_planner.hpp"

namespace lstm_planner {

/// Goes where a RollingPlanner says, and nothing else: what the networks with these inputs are to be better than. It
/// may walk in circles for ever where the path round is longer than its window.
class RollingAgent : public GridAgent {
 public:
  explicit RollingAgent(CornerCutting corner_cutting = CornerCutting::kForbidden) : planner_(corner_cutting) {}

  void start(CellIndex /*start*/, CellIndex /*goal*/) override { planner_.start(); }
  void observe(const GridObservation& observation) override { planner_.observe(observation); }
  int decide() override { return planner_.direction(); }
  GridLeader leader() const override { return GridLeader::kSearch; }
  void step(int /*direction*/, bool /*moved*/) override {}
  std::size_t peakBytes() const override { return sizeof(*this) - sizeof(planner_) + planner_.bytes(); }
  std::size_t expandedCells() const override { return planner_.expandedCells(); }

 private:
  RollingPlanner planner_;
};

}  // namespace lstm_planner
