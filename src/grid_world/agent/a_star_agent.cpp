#include "grid_world/agent/a_star_agent.hpp"

#include <algorithm>
#include <utility>

namespace lstm_planner {

AStarAgent::AStarAgent(const PassableGrid& grid, AStarParameters parameters)
    : grid_(&grid), search_(grid, parameters) {}

void AStarAgent::start(CellIndex start, CellIndex goal) {
  goal_ = goal;
  expanded_ = 0;
  peak_bytes_ = 0;
  plan(start);
}

void AStarAgent::plan(CellIndex start) {
  AStarResult result = search_.find(start, goal_);
  path_ = std::move(result.path);
  place_ = 0;
  expanded_ += result.expanded;
  peak_bytes_ = std::max(peak_bytes_, result.peak_bytes + grid_->size());
}

void AStarAgent::observe(const GridObservation& observation) {
  if (!path_.found() || path_.cells[place_] == observation.cell) return;
  const bool went_on = place_ + 1 < path_.cells.size() && path_.cells[place_ + 1] == observation.cell;
  if (went_on) {
    ++place_;
  } else {
    plan(observation.cell);
  }
}

int AStarAgent::decide() {
  if (place_ + 1 >= path_.cells.size()) return kNoPath;
  return rayBetween(path_.cells[place_], path_.cells[place_ + 1]);
}

}  // namespace lstm_planner
