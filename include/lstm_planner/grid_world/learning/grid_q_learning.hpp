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
/// Many agents walk at once, and the weights learn from the window of steps that all of them just made, instead of from
/// a replay memory: such steps are as little correlated as replayed ones (Mnih et al., "Asynchronous methods for deep
/// reinforcement learning", ICML 2016), and the hidden state in which a window starts is the one that today's network
/// has there, where a replayed window would need one that an older network left.
///
/// The reward of a step is how much shorter the true shortest path to the goal has become, less a cost; an arrival has
/// a bonus. Lengths are in cells, and an update is made after `window` steps of each agent.
struct GridQLearningParameters : QLearningParameters {
  GridCourseParameters course;
  int updates = 20000;  ///< of the weights, over all epochs
  int epochs = 10;      ///< 1 to `updates`; each with goals and episodes of its own, checkpoints lie between them
  int agents = 256;     ///< at a time; rounded up to whole tiles
};

/// Visits those of its own, named as the options; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitGridQLearningParameters(Parameters& p, const Visitor& visit) {
  visit("updates", p.updates, {1, 1e9}, "", "number of updates of the weights, in all epochs together");
  visit("agents", p.agents, {1, 1e5}, "", "number of agents at the same time");
  visit("window", p.window, {1, 1e5}, "", "steps of each agent per update");
  visit("max-steps", p.max_steps, {1, 1e9}, "", "largest number of steps of a training episode");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const GridQLearningParameters& parameters);

/// The training: a step is an update, and after each epoch it is judged.
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

/// `layers` with weights to start from; kGridInputs inputs and kGridMoveCount outputs. Throws std::invalid_argument for
/// what does not fit, and as GridCourse.
std::unique_ptr<GridQLearning> makeGridQLearning(const GridQLearningParameters& parameters,
                                                 std::vector<GridCourse::Set> maps, LayerStack layers);

}  // namespace lstm_planner
