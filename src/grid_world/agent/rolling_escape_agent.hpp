#pragma once

#include "lstm_planner/grid_world/agent/grid_guide.hpp"

namespace lstm_planner {

/// Follows the remembered path and nothing else: all that the shipped agent has but for its network, so certain to
/// arrive.
class RollingEscapeAgent : public GridAgent {
 public:
  explicit RollingEscapeAgent(const GridGuideParameters& parameters) : guide_(parameters) {}

  void start(CellIndex start, CellIndex /*goal*/) override { guide_.start(start); }
  void observe(const GridObservation& observation) override { guide_.observe(observation); }
  int decide() override { return guide_.direction(); }
  GridLeader leader() const override { return guide_.leader(); }
  std::size_t peakBytes() const override { return sizeof(*this) + guide_.bytes(); }
  std::size_t expandedCells() const override { return guide_.expandedCells(); }

 private:
  GridGuide guide_;
};

}  // namespace lstm_planner
