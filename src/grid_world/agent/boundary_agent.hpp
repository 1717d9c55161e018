#pragma once

#include "lstm_planner/grid_world/agent/boundary_follower.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"

namespace lstm_planner {

/// BoundaryFollower as an agent of its own: certain to arrive, or to say that there is no path.
class BoundaryAgent : public GridAgent {
 public:
  explicit BoundaryAgent(const BoundaryParameters& parameters = {}) : follower_(parameters) {}

  void start(CellIndex /*start*/, CellIndex /*goal*/) override { follower_.start(); }
  void observe(const GridObservation& observation) override { follower_.observe(observation); }
  int decide() override { return follower_.decide(); }
  GridLeader leader() const override { return GridLeader::kBoundary; }
  void step(int /*direction*/, bool /*moved*/) override {}
  std::size_t peakBytes() const override { return follower_.peakBytes(); }

 private:
  BoundaryFollower follower_;
};

}  // namespace lstm_planner
