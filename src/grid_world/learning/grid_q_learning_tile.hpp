#pragma once

#include <Eigen/Core>
#include <vector>

#include "grid_world/learning/grid_actor.hpp"
#include "lstm_planner/grid_world/learning/grid_q_learning.hpp"
#include "lstm_planner/training/lane_network.hpp"
#include "lstm_planner/training/q_learning_targets.hpp"

namespace lstm_planner {

/// What goes into the report.
struct QSums {
  ValueSums values;
  double reward = 0;
  GridEpisodeSums episodes;
  void operator+=(const QSums& other);
};
std::vector<double*> numbersOf(QSums* sums);

/// Agents that go through a window together, and what they carry from one window to the next.
struct QTile {
  static constexpr int kActors = 64;  ///< each in a lane of the network; the rows of a step stay in the first cache

  std::vector<GridActor> actors;
  std::vector<float> state;         ///< hidden
  std::vector<float> target_state;  ///< hidden, of the target network
  bool observed = false;            ///< whether the agents have sensed where they are
  Eigen::VectorXf gradient;         ///< sum over the window's steps
};

/// Leads tiles of agents through a window, and works out the gradient. One a thread.
class QTileRunner {
 public:
  /// `parameters` must outlive the runner.
  QTileRunner(const GridQLearningParameters& parameters, const LayerStack& layers);

  QSums run(const Eigen::VectorXf& weights, const Eigen::VectorXf& target_weights, double epsilon, QTile* tile);

 private:
  void observe(int step, QTile* tile);
  void valueState(int step, int actor, const GridActor& walker);
  void move(int step, int actor, double epsilon, GridActor* walker);
  void judge(int actor);

  const GridQLearningParameters& parameters_;
  LaneNetwork network_;
  LaneNetwork target_network_;                     ///< one step long: nothing goes back through it
  std::vector<std::vector<QTransition>> windows_;  ///< of each agent; one step more, of which only the value counts
  QSums sums_;                                     ///< of the window
};

}  // namespace lstm_planner
