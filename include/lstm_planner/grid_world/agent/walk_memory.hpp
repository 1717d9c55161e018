#pragma once

#include <cstddef>

#include "lstm_planner/grid_world/agent/opening_memory.hpp"
#include "lstm_planner/grid_world/agent/start_distance.hpp"

namespace lstm_planner {

/// What an agent remembers of its walk besides where it was how often.
struct WalkMemory {
  StartDistance start_distance;
  OpeningMemory openings;

  void start() {
    start_distance.clear();
    openings.clear();
  }
  /// `trace` has seen the step.
  void observe(const GridObservation& observation, const VisitTrace& trace) {
    start_distance.observe(observation);
    openings.observe(observation, trace, start_distance.here());
  }

  static std::size_t bytes() { return StartDistance::bytes() + OpeningMemory::bytes(); }
};

}  // namespace lstm_planner
