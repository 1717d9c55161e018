#include "lstm_planner/agent/grid_escape.hpp"

namespace lstm_planner {

GridEscape::GridEscape(const GridEscapeParameters& parameters)
    : parameters_(parameters), follower_(parameters.boundary) {}

void GridEscape::start() {
  started_ = false;
  active_ = false;
  activations_ = 0;
}

void GridEscape::observe(const GridObservation& observation) {
  const OctileDistance distance = octileDistance(observation.cell, observation.goal);
  if (!started_ || distance < best_) {
    started_ = true;
    best_ = distance;
    steps_since_best_ = 0;
    if (active_ && distance.length() <= hand_back_below_) active_ = false;
  } else {
    ++steps_since_best_;
  }
  if (!active_ && steps_since_best_ >= parameters_.patience) {
    active_ = true;
    ++activations_;
    hand_back_below_ = best_.length() - parameters_.margin;
    follower_.start();
  }
  if (active_) follower_.observe(observation);
}

}  // namespace lstm_planner
