#pragma once

#include "grid_world/agent/grid_walk.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/learning/grid_course.hpp"

namespace lstm_planner {

/// Rewards of reinforcement learning in the grid world, in cells.
struct GridRewards {
  /// What the distance to the goal after a step counts: with the discount of the returns, what the agent comes nearer
  /// does not change which policy is the best one (Ng et al., "Policy invariance under reward transformations", ICML
  /// 1999).
  double distance_weight = 1.0;
  double step_cost = 0.2;       ///< of every step, besides what it brings the agent nearer to the goal
  double arrival_bonus = 10.0;  ///< for coming within one cell of the goal
};

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

  GridActor(const GridCourse& course, const GridEncoderParameters& encoder, std::uint64_t seed)
      : course_(&course), random_(seed), memory_(makeGridMemory(encoder)) {
    startEpisode();
  }

  bool atStart() const { return walk_.moves() == 0; }
  /// Senses; once before each step().
  void observe() { memory_.observe(walk_.observe()); }
  const GridMemory& memory() const { return memory_; }
  /// Whether the shield allows a move.
  bool possible(int direction) const {
    return movePossible(memory_.observation().ranges, direction, CornerCutting::kForbidden);
  }
  Random& random() { return random_; }
  std::size_t set() const { return episode_.set; }  ///< of the course

  /// True length of the path to the goal from here, and from the cell beside (+inf when blocked), cells.
  float distance() const { return episode_.goal->distances.at(walk_.cell()); }
  float distanceBeside(int direction) const { return episode_.goal->distances.at(cellBeside(walk_.cell(), direction)); }

  /// `direction` must be possible. Where the episode ends the next one starts.
  Outcome step(int direction, const GridRewards& rewards, int max_steps);

 private:
  void startEpisode();
  double progress(float before, bool arrived, const GridRewards& rewards) const;

  const GridCourse* course_;
  Random random_;
  GridCourse::Episode episode_;
  GridMemory memory_;
  GridWalk walk_;
  double walked_ = 0.0;  ///< cells
};

/// What became of the episodes that ended.
struct GridEpisodeSums {
  double ended = 0.0, arrived = 0.0, ratio = 0.0;

  void count(const GridActor::Outcome& outcome);
  void operator+=(const GridEpisodeSums& other);
  double arrival() const { return ended > 0.0 ? arrived / ended : 0.0; }      ///< share
  double meanRatio() const { return arrived > 0.0 ? ratio / arrived : 0.0; }  ///< of those that arrived
};

}  // namespace lstm_planner
