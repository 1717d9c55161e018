#pragma once

#include "lstm_planner/common/progress_watch.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"
#include "lstm_planner/grid_world/search/exact_octile.hpp"

namespace lstm_planner {

/// For how long an agent has got neither nearer to the goal than ever (octile distance) nor to a new place.
class GridProgressWatch {
 public:
  void start() { nearest_.clear(); }

  /// Before each step. `new_place`: the agent has not been here before, as far as it can tell. Whether it is nearer
  /// than ever.
  bool observe(const GridObservation& observation, bool new_place) {
    // On the largest grids, too, two lengths differ by more than rounding, or are the same.
    const bool is_best = nearest_.note(octileDistance(observation.cell, observation.goal).length());
    steps_in_known_places_ = new_place || is_best ? 0 : steps_in_known_places_ + 1;
    return is_best;
  }

  double best() const { return nearest_.best(); }  ///< cells
  /// `long_patience` counts new places, too.
  bool isExhausted(int patience, int long_patience) const {
    return steps_in_known_places_ >= patience || nearest_.steps() >= long_patience;
  }

 private:
  ProgressWatch nearest_{0.0};
  int steps_in_known_places_ = 0;
};

}  // namespace lstm_planner
