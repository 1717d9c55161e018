#pragma once

#include "lstm_planner/grid_world/agent/grid_agent.hpp"
#include "lstm_planner/grid_world/search/exact_octile.hpp"

namespace lstm_planner {

/// For how long an agent has got neither nearer to the goal than ever (octile distance) nor to a new place.
class ProgressWatch {
 public:
  void start() { started_ = false; }

  /// Before each step. `new_place`: the agent has not been here before, as far as it can tell. Whether it is nearer
  /// than ever.
  bool observe(const GridObservation& observation, bool new_place) {
    const OctileDistance distance = octileDistance(observation.cell, observation.goal);
    steps_in_known_places_ = new_place ? 0 : steps_in_known_places_ + 1;
    ++steps_since_best_;
    if (started_ && !(distance < best_)) return false;
    started_ = true;
    best_ = distance;
    steps_since_best_ = 0;
    steps_in_known_places_ = 0;
    return true;
  }

  OctileDistance best() const { return best_; }
  /// `long_patience` counts new places, too.
  bool isExhausted(int patience, int long_patience) const {
    return steps_in_known_places_ >= patience || steps_since_best_ >= long_patience;
  }

 private:
  bool started_ = false;
  OctileDistance best_;
  int steps_since_best_ = 0;
  int steps_in_known_places_ = 0;
};

}  // namespace lstm_planner
