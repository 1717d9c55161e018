#include "grid_world/learning/grid_actor.hpp"

namespace lstm_planner {

void GridActor::startEpisode() {
  episode_ = course_->draw(random_);
  walk_ = GridWalk(episode_.goal->map->ranges, episode_.start, episode_.goal->goal);
  walked_ = 0.0;
  previous_direction_ = kNoPath;
}

GridActor::Outcome GridActor::step(int direction, int max_steps) {
  const float before = distance();
  walk_.move(direction);
  walked_ += moveLength(direction);
  previous_direction_ = direction;
  Outcome outcome;
  outcome.arrived = walk_.hasArrived();
  outcome.timed_out = !outcome.arrived && walk_.moves() >= max_steps;
  outcome.reward = static_cast<double>(before - distance()) - kStepCost;
  if (outcome.arrived) {
    outcome.reward += kArrivalBonus;
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

}  // namespace lstm_planner
