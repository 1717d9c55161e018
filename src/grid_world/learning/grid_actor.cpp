#include "grid_world/learning/grid_actor.hpp"

#include <algorithm>
#include <cstdlib>

namespace lstm_planner {

void GridActor::startEpisode() {
  episode_ = course_->draw(random_);
  cell_ = episode_.start;
  memory_.start();
  steps_ = 0;
  walked_ = 0.0;
}

void GridActor::observe() { memory_.observe({cell_, episode_.goal->goal, episode_.goal->map->ranges.at(cell_)}); }

GridActor::Outcome GridActor::step(int direction, const GridRewards& rewards, int max_steps) {
  const float before = distance();
  cell_ = cellBeside(cell_, direction);
  memory_.step(direction);
  ++steps_;
  walked_ += moveLength(direction);
  const CellIndex goal = episode_.goal->goal;
  Outcome outcome;
  outcome.arrived = std::max(std::abs(goal.column - cell_.column), std::abs(goal.row - cell_.row)) <= 1;
  outcome.timed_out = !outcome.arrived && steps_ >= max_steps;
  outcome.reward = static_cast<double>(before - distance()) - rewards.step_cost;
  if (outcome.arrived) outcome.reward += rewards.arrival_bonus;
  return outcome;
}

}  // namespace lstm_planner
