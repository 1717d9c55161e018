#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "grid_world/agent/grid_walk.hpp"
#include "lstm_planner/common/random.hpp"
#include "lstm_planner/grid_world/agent/grid_agent.hpp"
#include "lstm_planner/grid_world/learning/grid_course.hpp"
#include "lstm_planner/grid_world/learning/grid_q_learning.hpp"
#include "lstm_planner/training/lane_network.hpp"

namespace lstm_planner {

/// One agent that learns: walks through one episode after the other.
class GridActor {
 public:
  // Of the reward, cells.
  static constexpr double kStepCost = 0.2;
  static constexpr double kArrivalBonus = 10.0;

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
  bool possible(int direction) const { return movePossible(observation_.ranges, direction, course_->cornerCutting()); }
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

/// What is added up over the steps of a window.
struct QSums {
  double steps = 0.0;
  double squared_error = 0.0;  ///< of the values of the moves that were made
  double reward = 0.0;
  double ended = 0.0;    ///< episodes
  double arrived = 0.0;  ///< of these
  double ratio = 0.0;    ///< length / optimum of the episodes that arrived

  QSums& operator+=(const QSums& other);
};

/// Agents that go through one window after the other together: what one thread works on.
class QTile {
 public:
  static constexpr int kActors = 64;  ///< each in a lane of the network; the rows of a step stay in the first cache
  static constexpr double kValueScale = 20.0;  ///< an output of the network times this is a value, cells

  /// New agents. `parameters` and `course` must outlive the tile.
  QTile(const GridQLearningParameters& parameters, const LayerStack& layers, const GridCourse& course, Random* seeds);

  /// Leads the agents through a window, and works out the gradient.
  QSums run(const Eigen::VectorXf& weights, const Eigen::VectorXf& target_weights, double epsilon);
  const Eigen::VectorXf& gradient() const { return gradient_; }  ///< sum over the window's steps

 private:
  void observe(int step);
  void valueState(int step, int actor);
  void move(int step, int actor, double epsilon);
  void judge(int actor);

  const GridQLearningParameters& parameters_;
  std::vector<GridActor> actors_;
  bool observed_ = false;  ///< whether the agents have sensed where they are
  LaneNetwork network_;
  LaneNetwork target_network_;                     ///< one step long: nothing goes back through it
  std::vector<std::vector<QTransition>> windows_;  ///< of each agent; one step more, of which only the value counts
  QSums sums_;                                     ///< of the window
  Eigen::VectorXf gradient_;
};

}  // namespace lstm_planner
