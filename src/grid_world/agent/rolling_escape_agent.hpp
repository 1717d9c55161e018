#pragma once

#include "lstm_planner/grid_world/agent/greedy_agent.hpp"
#include "lstm_planner/grid_world/agent/grid_escape.hpp"
#include "lstm_planner/grid_world/agent/rolling_planner.hpp"
#include "lstm_planner/grid_world/agent/visit_trace.hpp"

namespace lstm_planner {

/// A RollingPlanner with the escape of the networks: all that the shipped agent has but for its network, so certain to
/// arrive. Where the walls that it remembers enclose it or the goal, it goes to the neighbour nearest to the goal until
/// the escape takes over: the window may have forgotten the way out.
class RollingEscapeAgent : public GridAgent {
 public:
  RollingEscapeAgent(CornerCutting corner_cutting, GridEscapeParameters escape);

  void start(CellIndex start, CellIndex goal) override;
  void observe(const GridObservation& observation) override;
  int decide() override;
  GridLeader leader() const override;
  void step(int /*direction*/, bool /*moved*/) override {}
  std::size_t peakBytes() const override;
  std::size_t expandedCells() const override { return planner_.expandedCells(); }

 private:
  RollingPlanner planner_;
  VisitTrace trace_;  ///< what is a new place, for the escape's patience
  GridEscape escape_;
  GreedyAgent greedy_;
};

}  // namespace lstm_planner
