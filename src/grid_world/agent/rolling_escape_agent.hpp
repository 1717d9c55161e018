#pragma once

#include <optional>

#include "lstm_planner/grid_world/agent/greedy_agent.hpp"
#include "lstm_planner/grid_world/agent/grid_rescue.hpp"
#include "lstm_planner/grid_world/agent/rolling_planner.hpp"
#include "lstm_planner/grid_world/agent/visit_trace.hpp"

namespace lstm_planner {

/// A RollingPlanner with the rescue of the networks: all that the shipped agent has but for its network, so certain to
/// arrive. Where the walls that it remembers enclose it or the goal, it goes to the neighbour nearest to the goal until
/// the rescue takes over: the window may have forgotten the way out.
class RollingEscapeAgent : public GridAgent {
 public:
  explicit RollingEscapeAgent(const GridRescueParameters& parameters);

  void start(CellIndex start, CellIndex goal) override;
  void observe(const GridObservation& observation) override;
  int decide() override;
  GridLeader leader() const override;
  void step(int /*direction*/, bool /*moved*/) override {}
  std::size_t peakBytes() const override;
  std::size_t expandedCells() const override;

 private:
  /// What it needs until the rescue takes over.
  struct Memory {
    RollingPlanner planner;
    VisitTrace trace;  ///< what is a new place, for the rescue's patience
  };

  void lookAhead(const GridObservation& observation);

  CornerCutting corner_cutting_;
  std::optional<Memory> memory_;
  GridRescue rescue_;
  GreedyAgent greedy_;
  std::size_t expanded_ = 0;    ///< by the planner, where it is gone
  std::size_t peak_bytes_ = 0;  ///< of what is not needed at the same time
};

}  // namespace lstm_planner
