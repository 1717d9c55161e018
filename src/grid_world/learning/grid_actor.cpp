#include "grid_world/learning/grid_actor.hpp"

#include <cmath>

#include "lstm_planner/grid_world/search/exact_octile.hpp"

namespace lstm_planner {
namespace {

/// From the move before to the path to the goal, rad, in [0, pi].
double turnToGoal(const GridObservation& observation, int previous_direction) {
  if (previous_direction == kNoPath) return 0.0;
  const CellIndex step = kGridRaySteps[static_cast<std::size_t>(previous_direction)];
  const double columns = observation.goal.column - observation.cell.column;
  const double rows = observation.goal.row - observation.cell.row;
  return std::abs(std::atan2(step.column * rows - step.row * columns, step.column * columns + step.row * rows));
}

}  // namespace

double thesisReward(const GridObservation& observation, int previous_direction, const ThesisRewardWeights& weights) {
  double proximity = 0.0;
  for (const auto range : observation.ranges) proximity += 1.0 / range;
  const double distance = octileDistance(observation.cell, observation.goal).length();
  return -(weights.range * proximity + weights.distance * distance +
           weights.angle * turnToGoal(observation, previous_direction));
}

void GridActor::startEpisode() {
  episode_ = course_->draw(random_);
  walk_ = GridWalk(episode_.goal->map->ranges, episode_.start, episode_.goal->goal);
  walked_ = 0.0;
  previous_direction_ = kNoPath;
}

GridActor::Outcome GridActor::step(int direction, const GridQLearningParameters& parameters) {
  const float before = distance();
  const double thesis_reward = thesisReward(observation_, previous_direction_, parameters.thesis_reward);
  walk_.move(direction);
  walked_ += moveLength(direction);
  previous_direction_ = direction;
  Outcome outcome;
  outcome.arrived = walk_.hasArrived();
  outcome.timed_out = !outcome.arrived && walk_.moves() >= parameters.max_steps;
  outcome.reward = static_cast<double>(before - distance()) - parameters.step_cost;
  if (outcome.arrived) {
    outcome.reward += parameters.arrival_bonus;
    outcome.ratio = walked_ / static_cast<double>(episode_.goal->distances.at(episode_.start));
  }
  if (parameters.reward == QLearningParameters::Reward::kThesis) outcome.reward = thesis_reward;
  if (outcome.arrived || outcome.timed_out) startEpisode();
  return outcome;
}

void GridEpisodeSums::count(const GridActor::Outcome& outcome) {
  if (!outcome.arrived && !outcome.timed_out) return;
  ended += 1.0;
  if (!outcome.arrived) return;
  arrived += 1.0;
  ratio += outcome.ratio;
}

}  // namespace lstm_planner
