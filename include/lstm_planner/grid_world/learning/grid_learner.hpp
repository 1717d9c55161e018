#pragma once

#include "lstm_planner/grid_world/learning/grid_course.hpp"
#include "lstm_planner/training/reinforcement_learner.hpp"

namespace lstm_planner {

/// Visits what all learners in the grid world have in common, named as the options; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitGridLearnerParameters(Parameters& p, const Visitor& visit) {
  visit("updates", p.updates, {1, 1e9}, "", "number of updates of the weights, in all epochs together");
  visit("agents", p.agents, {1, 1e5}, "", "number of agents at the same time");
  visit("window", p.window, {1, 1e5}, "", "steps of each agent per update");
  visit("max-steps", p.max_steps, {1, 1e9}, "", "largest number of steps of a training episode");
}

/// A network that learns while its agents walk through a course: makeGridActorCritic(), makeGridQLearning(). Its
/// checkpoints are of the time between two epochs.
class GridLearner : public ReinforcementLearner {
 public:
  /// Starts epoch `epoch` (from 0) with new episodes of `course`, which must outlive it. What happens in it depends
  /// only on the weights and the seed.
  virtual void startEpoch(int epoch, const GridCourse& course) = 0;

  /// One window of all agents, and one step of the optimisers. Of several ranks all have to call it.
  virtual void update() = 0;

  /// Since the last call.
  virtual ReinforcementReport report() = 0;
};

}  // namespace lstm_planner
