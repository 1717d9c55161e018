#pragma once

#include <algorithm>
#include <cstddef>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/progress_watch.hpp"
#include "lstm_planner/grid_world/agent/boundary_follower.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"
#include "lstm_planner/grid_world/search/exact_octile.hpp"

namespace lstm_planner {

/// When the escape takes over, and when it hands back.
struct GridEscapeParameters {
  BoundaryParameters boundary;
  /// Steps without a new best distance to the goal and without a new place, before the escape takes over.
  int patience = 150;
  /// Steps without a new best distance, with new places or without: so new places do not delay the escape for ever.
  int long_patience = 2000;
  /// The escape hands back when the distance to the goal is so many cells less than the best one at the takeover, or at
  /// the goal.
  double margin = 40.0;
};

/// Last resort of an agent that is not certain to arrive: watches its best distance to the goal (octile), and takes
/// over if that has not improved for too long.
///
/// Whatever the agent does, the two together arrive if there is a path. Boundary following (BoundaryFollower) is
/// certain to arrive from anywhere, so the escape reaches a cell with a new best distance, which may be the goal. Then
/// the agent goes on. Each such cell is nearer than the one before, and a finite grid has finitely many.
///
/// Call observe() before each step, also if the agent decides it; while active(), go where decide() says.
class GridEscape {
 public:
  /// Throws std::invalid_argument for a patience below one step and a margin that is negative or not finite.
  explicit GridEscape(const GridEscapeParameters& parameters = {})
      : parameters_(parameters), follower_(parameters.boundary) {
    checkParameter(parameters.patience >= 1, "patience", parameters.patience, "at least one step");
    checkParameter(parameters.long_patience >= 1, "long_patience", parameters.long_patience, "at least one step");
    checkNotNegative("margin", parameters.margin);
  }

  /// A new episode.
  void start() {
    nearest_.clear();
    active_ = false;
  }

  /// `new_place`: as far as the agent knows, it has not been here before.
  void observe(const GridObservation& observation, bool new_place = false) {
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

  /// Takes over at once; after observe().
  void takeOver(const GridObservation& observation) {
    active_ = true;
    hand_back_below_ = std::max(0.0, nearest_.best() - parameters_.margin);
    follower_.start(observation.cell, observation.goal);
    follower_.observe(observation);
  }

  bool active() const { return active_; }

  /// The direction to move in, or kNoPath when the goal cannot be reached. Only while active.
  int decide() { return follower_.decide(); }

  std::size_t peakBytes() const { return sizeof(*this) - sizeof(follower_) + follower_.peakBytes(); }

 private:
  GridEscapeParameters parameters_;
  BoundaryFollower follower_;
  ProgressWatch nearest_{0.0};     ///< cells to the goal
  int steps_in_known_places_ = 0;  ///< without a new best distance and without a new place
  double hand_back_below_ = 0.0;   ///< cells to the goal
  bool active_ = false;
};

}  // namespace lstm_planner
