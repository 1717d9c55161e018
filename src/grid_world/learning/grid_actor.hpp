#pragma once

#include "grid_world/agent/grid_walk.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"
#include "lstm_planner/grid_world/learning/grid_course.hpp"

namespace lstm_planner {

// Of the reward, cells.
constexpr double kStepCost = 0.2;
constexpr double kArrivalBonus = 10.0;

/// One agent that learns: walks through one episode after the other.
class GridActor {
 public:
  /// Of a step.
  struct Outcome {
    double reward = 0.0;
    bool arrived = false;
    bool timed_out = false;
    double ratio = 0.0;  ///< length / optimum, where it arrived
  };

  GridActor(const GridCourse& course, std::uint64_t seed) : course_(&course), random_(seed) { startEpisode(); }

  bool atStart() const { return walk_.moves() == 0; }
  /// Senses; once before each step().
  void observe() { observation_ = walk_.observe(); }
  const GridObservation& observation() const { return observation_; }
  int previousDirection() const { return previous_direction_; }  ///< kNoPath before the first move
  /// Whether the shield allows a move.
  bool possible(int direction) const { return movePossible(observation_.ranges, direction, CornerCutting::kForbidden); }
  Random& random() { return random_; }

  /// `direction` must be possible. Where the episode ends, at the latest after `max_steps`, the next one starts.
  Outcome step(int direction, int max_steps);

 private:
  void startEpisode();
  float distance() const { return episode_.goal->distances.at(walk_.cell()); }  ///< along the shortest path, cells

  const GridCourse* course_;
  Random random_;
  GridCourse::Episode episode_;
  GridObservation observation_;
  int previous_direction_ = kNoPath;
  GridWalk walk_;
  double walked_ = 0.0;  ///< cells
};

/// What became of the episodes that ended.
struct GridEpisodeSums {
  double ended = 0.0, arrived = 0.0, ratio = 0.0;

  void count(const GridActor::Outcome& outcome);
  double arrival() const { return ended > 0.0 ? arrived / ended : 0.0; }      ///< share
  double meanRatio() const { return arrived > 0.0 ? ratio / arrived : 0.0; }  ///< of those that arrived
};

}  // namespace lstm_planner
