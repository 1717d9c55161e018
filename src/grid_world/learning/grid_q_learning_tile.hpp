#pragma once

#include <Eigen/Core>
#include <vector>

#include "grid_world/learning/grid_actor.hpp"
#include "lstm_planner/grid_world/learning/grid_q_learning.hpp"
#include "lstm_planner/training/lane_network.hpp"

namespace lstm_planner {

/// An output of the network times this is a value, cells.
constexpr double kValueScale = 20.0;

/// What is added up over the steps of a window.
struct QSums {
  double steps = 0.0;
  double value = 0.0;          ///< of the moves that were made
  double squared_error = 0.0;  ///< of these values
  double reward = 0.0;
  GridEpisodeSums episodes;
};
std::vector<double*> numbersOf(QSums* sums);

/// Agents that go through one window after the other together: what one thread works on.
class QTile {
 public:
  static constexpr int kActors = 64;  ///< each in a lane of the network; the rows of a step stay in the first cache

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
