#pragma once

#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/learning/grid_course.hpp"

namespace lstm_planner {

/// Rewards of reinforcement learning in the grid world, in cells.
struct GridRewards {
  double step_cost = 0.2;       ///< of every step, besides what it brings the agent nearer to the goal
  double arrival_bonus = 10.0;  ///< for coming within one cell of the goal
};

/// One agent that learns: walks through one episode after the other.
class GridActor {
 public:
  struct Outcome {
    double reward = 0.0;
    bool arrived = false;
    bool timed_out = false;
    bool ended() const { return arrived || timed_out; }
  };

  GridActor(const GridCourse& course, const GridEncoderParameters& encoder, std::uint64_t seed)
      : course_(&course), random_(seed), memory_(makeGridMemory(encoder)) {
    startEpisode();
  }

  bool atStart() const { return steps_ == 0; }
  /// Senses; once before each step().
  void observe();
  const GridMemory& memory() const { return memory_; }
  const GridRanges& ranges() const { return memory_.observation().ranges; }
  Random& random() { return random_; }
  std::size_t set() const { return episode_.set; }  ///< of the course

  /// True length of the path to the goal from here, and from the cell beside (+inf when blocked), cells.
  float distance() const { return episode_.goal->distances.at(cell_); }
  float distanceBeside(int direction) const { return episode_.goal->distances.at(cellBeside(cell_, direction)); }
  double walked() const { return walked_; }
  float optimum() const { return episode_.goal->distances.at(episode_.start); }

  /// `direction` must be possible. After an outcome that ended, startEpisode().
  Outcome step(int direction, const GridRewards& rewards, int max_steps);
  void startEpisode();

 private:
  const GridCourse* course_;
  Random random_;
  GridCourse::Episode episode_;
  GridMemory memory_;
  CellIndex cell_;
  int steps_ = 0;
  double walked_ = 0.0;
};

}  // namespace lstm_planner
