#include "lstm_planner/grid_world/agent/grid_escape.hpp"

#include <algorithm>

#include "lstm_planner/base/common/parameter_check.hpp"

namespace lstm_planner {

GridEscape::GridEscape(const GridEscapeParameters& parameters)
    : parameters_(parameters), follower_(parameters.boundary) {
  checkParameter(parameters.patience >= 1, "patience", parameters.patience, "at least one step");
  checkParameter(parameters.long_patience >= 1, "long_patience", parameters.long_patience, "at least one step");
  checkParameter(parameters.margin >= 0.0, "margin", parameters.margin, "a number that is not negative");
}

void GridEscape::start() {
  started_ = false;
  active_ = false;
  activations_ = 0;
}

void GridEscape::observe(const GridObservation& observation, bool new_place) {
  const OctileDistance distance = octileDistance(observation.cell, observation.goal);
  steps_in_known_places_ = new_place ? 0 : steps_in_known_places_ + 1;
  if (!started_ || distance < best_) {
    started_ = true;
    best_ = distance;
    steps_since_best_ = 0;
    steps_in_known_places_ = 0;
    if (active_ && distance.length() <= hand_back_below_) active_ = false;
  } else {
    ++steps_since_best_;
  }
  if (!active_ && (steps_in_known_places_ >= parameters_.patience || steps_since_best_ >= parameters_.long_patience)) {
    active_ = true;
    ++activations_;
    hand_back_below_ = std::max(0.0, best_.length() - parameters_.margin);
    follower_.start();
  }
  if (active_) follower_.observe(observation);
}

}  // namespace lstm_planner
