#include "lstm_planner/grid_world/agent/seen_grid.hpp"

namespace lstm_planner {

void SeenGrid::restart(CellIndex agent) {
  cells_.restart(agent);
  changed_blocks_.clear();
  changed_blocks_.reserve(kMostChanges);
}

void SeenGrid::observe(const GridObservation& observation) {
  changed_blocks_.clear();
  cells_.keepInside(observation.cell, kMargin);
  set(observation.cell, Cell::kFree);
  for (std::size_t direction = 0; direction < kGridRayCount; ++direction) {
    for (int steps = 1; steps < observation.ranges[direction]; ++steps) {
      set(alongRay(observation.cell, direction, steps), Cell::kFree);
    }
  }
  // Once all that is free is known: less lies in gaps then.
  for (std::size_t direction = 0; direction < kGridRayCount; ++direction) {
    const int range = observation.ranges[direction];
    if (range < kGridRayCap) markWall(alongRay(observation.cell, direction, range));
  }
}

void SeenGrid::set(CellIndex cell, Cell value) {
  if (at(cell) == value) return;
  cells_.set(cell, static_cast<unsigned>(value));
  const CellIndex block = blockOf(cell);
  const bool listed = !changed_blocks_.empty() && changed_blocks_.back() == block;
  if (!listed && changed_blocks_.size() < kMostChanges) changed_blocks_.push_back(block);
}

void SeenGrid::markWall(CellIndex cell) {
  if (at(cell) == Cell::kWall) return;
  set(cell, Cell::kWall);
  for (std::size_t direction = 0; direction < kGridRayCount; direction += 2) {
    for (int steps = 1; steps <= kWidestGap; ++steps) {
      const CellIndex beside = alongRay(cell, direction, steps);
      const Cell seen = at(beside);
      if (seen == Cell::kFree || seen == Cell::kWall) break;
      if (seen == Cell::kUnknown && isInGap(beside)) set(beside, Cell::kDoubtful);
    }
  }
}

bool SeenGrid::isInGap(CellIndex cell) const {
  for (std::size_t direction = 0; direction < kGridRayCount / 2; direction += 2) {
    const int before = wallWithin(cell, direction);
    if (before == 0) continue;
    const int behind = wallWithin(cell, direction + kGridRayCount / 2);
    if (behind != 0 && before + behind - 1 <= kWidestGap) return true;
  }
  return false;
}

int SeenGrid::wallWithin(CellIndex cell, std::size_t direction) const {
  for (int steps = 1; steps <= kWidestGap; ++steps) {
    const Cell seen = at(alongRay(cell, direction, steps));
    if (seen == Cell::kWall) return steps;
    if (seen == Cell::kFree) return 0;
  }
  return 0;
}

}  // namespace lstm_planner
