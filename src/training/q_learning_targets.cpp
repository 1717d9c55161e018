#include "lstm_planner/training/q_learning_targets.hpp"

#include <algorithm>

namespace lstm_planner {

std::vector<double> lambdaTargets(const std::vector<QTransition>& steps, double discount, double trace_decay) {
  std::vector<double> targets(steps.size() - 1);
  double following = steps.back().value;
  for (std::size_t index = targets.size(); index-- > 0;) {
    const QTransition& step = steps[index];
    targets[index] = step.timed_out ? step.estimate : step.reward + (step.arrived ? 0.0 : discount * following);
    // What came of a move that was not the best says nothing about what the best one is worth.
    const double trust = step.greedy && !step.timed_out ? trace_decay : 0.0;
    following = step.value + trust * (targets[index] - step.value);
  }
  return targets;
}

double huberDerivative(double error, double huber) { return std::clamp(error, -huber, huber); }

}  // namespace lstm_planner
