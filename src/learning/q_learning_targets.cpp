#include "q_learning_targets.hpp"

#include <algorithm>
#include <cmath>

namespace lstm_planner {
namespace {

/// From the move before to the way to the goal, rad, in [0, pi].
double turnToGoal(const GridMemory& memory) {
  if (memory.previousDirection() < 0) return 0.0;
  const GridObservation& observation = memory.observation();
  const CellIndex step = kGridRaySteps[static_cast<std::size_t>(memory.previousDirection())];
  const double columns = observation.goal.column - observation.cell.column;
  const double rows = observation.goal.row - observation.cell.row;
  return std::abs(std::atan2(step.column * rows - step.row * columns, step.column * columns + step.row * rows));
}

}  // namespace

std::vector<double> lambdaTargets(const std::vector<QTransition>& steps, double discount, double trace_decay) {
  std::vector<double> targets(steps.size() - 1);
  double following = steps.back().value;
  for (std::size_t index = targets.size(); index-- > 0;) {
    const QTransition& step = steps[index];
    targets[index] = step.timed_out ? step.estimate : step.reward + (step.arrived ? 0.0 : discount * following);
    // What came of a move that was not the best says nothing about what the best one is worth.
    const double trust = step.greedy && !step.timed_out ? trace_decay : 0.0;
    following = step.value + trust * (targets[index] - step.value);
    if (step.forced && !step.timed_out) following = targets[index];
  }
  return targets;
}

double huberDerivative(double error, double huber) { return std::clamp(error, -huber, huber); }

double explorationAt(double progress, double start, double end, double share) {
  return progress >= share ? end : start + (end - start) * progress / share;
}

double thesisReward(const GridMemory& memory, const ThesisRewardWeights& weights) {
  double proximity = 0.0;
  for (const auto range : memory.observation().ranges) proximity += 1.0 / range;
  return -(weights.range * proximity + weights.distance * memory.goalDistance() +
           weights.angle * turnToGoal(memory));
}

}  // namespace lstm_planner
