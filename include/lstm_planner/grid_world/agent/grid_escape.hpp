#pragma once

#include <cstddef>

#include "lstm_planner/common/progress_watch.hpp"
#include "lstm_planner/grid_world/agent/boundary_follower.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"

namespace lstm_planner {

/// When the escape takes over, and when it hands back.
struct GridEscapeParameters {
  BoundaryParameters boundary;
  /// Steps without having got nearer to the goal than ever, nor to a place never seen, before the escape takes over.
  int patience = 150;
  /// The same, new places or not: whatever an agent calls new, it cannot put the escape off for ever.
  int long_patience = 2000;
  /// Cells nearer than ever that the escape gets before it hands back, where the goal is not nearer than that.
  double margin = 40.0;
};

/// Last resort of an agent that is not certain to arrive: watches how near to the goal (octile distance) it has ever
/// been, and takes over when that has not improved for too long.
///
/// Whatever the agent does, the two together arrive wherever there is a path. The escape starts where the agent has
/// strayed to and is certain to arrive from there by itself (BoundaryFollower), which measures its progress from where
/// it started; so it reaches some cell nearer than ever, at the latest the goal. Then the agent goes on. Each such cell
/// is nearer than the one before, and a finite grid has finitely many.
///
/// Call observe() before each step, whoever makes it; while active(), go where decide() says.
class GridEscape {
 public:
  /// Throws std::invalid_argument for a patience below one step and a margin that is negative or not finite.
  explicit GridEscape(const GridEscapeParameters& parameters = {});

  /// A new episode.
  void start();

  /// `new_place`: the agent has not been here before, as far as it can tell.
  void observe(const GridObservation& observation, bool new_place = false);

  /// Without waiting any longer, after observe().
  void takeOver(const GridObservation& observation);

  bool active() const { return active_; }

  /// The direction to move in, or kNoPath when the goal cannot be reached. Only while active.
  int decide() { return follower_.decide(); }

  std::size_t peakBytes() const { return sizeof(*this) - sizeof(follower_) + follower_.peakBytes(); }

 private:
  GridEscapeParameters parameters_;
  BoundaryFollower follower_;
  ProgressWatch nearest_{0.0};     ///< cells to the goal
  int steps_in_known_places_ = 0;  ///< in which the agent got neither nearer to the goal than ever nor to a new place
  double hand_back_below_ = 0.0;   ///< cells to the goal
  bool active_ = false;
};

}  // namespace lstm_planner
