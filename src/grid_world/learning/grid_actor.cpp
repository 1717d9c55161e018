#include "grid_world/learning/grid_actor.hpp"

namespace lstm_planner {

void GridActor::startEpisode() {
  episode_ = course_->draw(random_);
  walk_ = GridWalk(episode_.goal->map->ranges, episode_.start, episode_.goal->goal);
  walked_ = 0.0;
  memory_.start();
}

/// Without weight, in single precision as where the shipped networks learned.
double GridActor::progress(float before, bool arrived, const GridRewards& rewards) const {
  if (rewards.distance_weight == 1.0) return static_cast<double>(before - distance());
  return static_cast<double>(before) - (arrived ? 0.0 : rewards.distance_weight * static_cast<double>(distance()));
}

GridActor::Outcome GridActor::step(int direction, const GridRewards& rewards, int max_steps) {
  const float before = distance();
  walk_.move(direction);
  walked_ += moveLength(direction);
  memory_.step(direction);
  Outcome outcome;
  outcome.arrived = walk_.isNear(1);
  outcome.timed_out = !outcome.arrived && walk_.moves() >= max_steps;
  outcome.reward = progress(before, outcome.arrived, rewards) - rewards.step_cost;
  if (outcome.arrived) {
    outcome.reward += rewards.arrival_bonus;
    outcome.ratio = walked_ / static_cast<double>(episode_.goal->distances.at(episode_.start));
  }
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

void GridEpisodeSums::operator+=(const GridEpisodeSums& other) {
  ended += other.ended;
  arrived += other.arrived;
  ratio += other.ratio;
}

}  // namespace lstm_planner
