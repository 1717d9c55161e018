#include "lstm_planner/grid_world/agent/grid_escape.hpp"

#include <algorithm>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/grid_world/search/exact_octile.hpp"

namespace lstm_planner {

GridEscape::GridEscape(const GridEscapeParameters& parameters)
    : parameters_(parameters), follower_(parameters.boundary) {
  checkParameter(parameters.patience >= 1, "patience", parameters.patience, "at least one step");
  checkParameter(parameters.long_patience >= 1, "long_patience", parameters.long_patience, "at least one step");
  checkNotNegative("margin", parameters.margin);
}

void GridEscape::start() {
  nearest_.clear();
  active_ = false;
}

void GridEscape::observe(const GridObservation& observation, bool new_place) {
  // On the largest grids, too, two lengths differ by more than rounding, or are the same.
  const bool is_best = nearest_.note(octileDistance(observation.cell, observation.goal).length());
  steps_in_known_places_ = new_place || is_best ? 0 : steps_in_known_places_ + 1;
  if (is_best && nearest_.best() <= hand_back_below_) active_ = false;
  if (active_) {
    follower_.observe(observation);
  } else if (steps_in_known_places_ >= parameters_.patience || nearest_.steps() >= parameters_.long_patience) {
    takeOver(observation);
  }
}

void GridEscape::takeOver(const GridObservation& observation) {
  active_ = true;
  hand_back_below_ = std::max(0.0, nearest_.best() - parameters_.margin);
  follower_.start(observation.cell, observation.goal);
  follower_.observe(observation);
}

}  // namespace lstm_planner
