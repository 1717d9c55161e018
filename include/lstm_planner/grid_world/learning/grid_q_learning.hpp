#pragma once

#include <memory>
#include <vector>

#include "lstm_planner/grid_world/learning/grid_course.hpp"
#include "lstm_planner/training/q_learner.hpp"
#include "lstm_planner/training/training_loop.hpp"

namespace lstm_planner {

/// Q-learning (Watkins and Dayan 1992; thesis Eq. 2.34-2.39) with a recurrent network whose outputs are the values of
/// the moves (Hausknecht and Stone, "Deep recurrent Q-learning for partially observable MDPs", 2015).
///
/// Many agents walk at the same time, and the weights learn from the window of steps that all of them just made,
/// instead of from a replay memory. Such steps are as little correlated as replayed ones (Mnih et al., "Asynchronous
/// methods for deep reinforcement learning", ICML 2016), and the hidden state at the start of a window is that of the
/// current network; for a replayed window it would be that of an older one.
///
/// The reward of a step is how much shorter the true shortest path to the goal has become, minus a cost; an arrival has
/// a bonus. Lengths are in cells, and an update is made after `window` steps of each agent.
struct GridQLearningParameters : QLearningParameters {
  GridCourseParameters course;
  int updates = 20000;  ///< of the weights, over all epochs
  int epochs = 10;      ///< 1 to `updates`; each has its own goals and episodes, checkpoints are between them
  int agents = 256;     ///< at a time; rounded up to whole tiles
};

/// Visits the parameters of its own that have an option, by the option's name; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitGridQLearningParameters(Parameters& p, const Visitor& visit) {
  visit("updates", p.updates, {1, 1e9}, "", "number of updates of the weights, in all epochs together");
  visit("agents", p.agents, {1, 1e5}, "", "number of agents at the same time");
  visit("window", p.window, {1, 1e5}, "", "steps of each agent per update");
  visit("max-steps", p.max_steps, {1, 1e9}, "", "largest number of steps of a training episode");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const GridQLearningParameters& parameters);

/// The training: a step is an update, and after each epoch the network is judged.
class GridQLearning : public SteppedTraining {
 public:
  virtual int epoch() const = 0;        ///< done so far
  virtual double progress() const = 0;  ///< share of the updates that are done

  struct Report {
    double steps = 0.0;    ///< of all agents since the start
    double reward = 0.0;   ///< mean of a step
    double arrival = 0.0;  ///< share of the episodes that ended
    double ratio = 0.0;    ///< mean length / optimum of those that arrived
  };
  /// Since the last call; means over nothing are 0.
  virtual Report report() = 0;
};

/// `layers` hold the weights to start from, and have kGridInputs inputs and kGridMoveCount outputs. Throws
/// std::invalid_argument if something does not fit, and as GridCourse.
std::unique_ptr<GridQLearning> makeGridQLearning(const GridQLearningParameters& parameters,
                                                 std::vector<GridCourse::Set> maps, LayerStack layers);

}  // namespace lstm_planner
