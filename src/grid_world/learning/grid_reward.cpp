#include "grid_world/learning/grid_reward.hpp"

#include <cmath>

namespace lstm_planner {
namespace {

/// From the move before to the path to the goal, rad, in [0, pi].
double turnToGoal(const GridMemory& memory) {
  if (memory.previousDirection() < 0) return 0.0;
  const GridObservation& observation = memory.observation();
  const CellIndex step = kGridRaySteps[static_cast<std::size_t>(memory.previousDirection())];
  const double columns = observation.goal.column - observation.cell.column;
  const double rows = observation.goal.row - observation.cell.row;
  return std::abs(std::atan2(step.column * rows - step.row * columns, step.column * columns + step.row * rows));
}

}  // namespace

double thesisReward(const GridMemory& memory, const ThesisRewardWeights& weights) {
  double proximity = 0.0;
  for (const auto range : memory.observation().ranges) proximity += 1.0 / range;
  return -(weights.range * proximity + weights.distance * memory.goalDistance() + weights.angle * turnToGoal(memory));
}

}  // namespace lstm_planner
