#include "lstm_planner/grid_world/agent/seen_grid.hpp"

namespace lstm_planner {
namespace {

CellIndex moved(CellIndex cell, CellIndex step, int steps) {
  return {cell.column + steps * step.column, cell.row + steps * step.row};
}

}  // namespace

void SeenGrid::restart(CellIndex agent) {
  cells_.restart(agent);
  changed_blocks_.clear();
  changed_blocks_.reserve(kMostChanges);
}

void SeenGrid::takeWalls(const RollingGrid& walls) {
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const CellIndex cell = {origin().column + column, origin().row + row};
      if (walls.isWall(cell)) markWall(cell);
    }
  }
}

void SeenGrid::observe(const GridObservation& observation) {
  changed_blocks_.clear();
  cells_.keepInside(observation.cell, kMargin);
  set(observation.cell, Cell::kFree);
  for (std::size_t direction = 0; direction < kGridRayCount; ++direction) {
    for (int steps = 1; steps < observation.ranges[direction]; ++steps) {
      set(moved(observation.cell, kGridRaySteps[direction], steps), Cell::kFree);
    }
  }
  // Once all that is free is known: less lies in gaps then.
  for (std::size_t direction = 0; direction < kGridRayCount; ++direction) {
    const int range = observation.ranges[direction];
    if (range < kGridRayCap) markWall(moved(observation.cell, kGridRaySteps[direction], range));
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
      const CellIndex beside = moved(cell, kGridRaySteps[direction], steps);
      const Cell seen = at(beside);
      if (seen == Cell::kFree || seen == Cell::kWall) break;
      if (seen == Cell::kUnknown && isInGap(beside)) set(beside, Cell::kDoubtful);
    }
  }
}

bool SeenGrid::isInGap(CellIndex cell) const {
  for (std::size_t direction = 0; direction < kGridRayCount / 2; direction += 2) {
    const int before = wallWithin(cell, kGridRaySteps[direction]);
    if (before == 0) continue;
    const int behind = wallWithin(cell, kGridRaySteps[direction + kGridRayCount / 2]);
    if (behind != 0 && before + behind - 1 <= kWidestGap) return true;
  }
  return false;
}

int SeenGrid::wallWithin(CellIndex cell, CellIndex step) const {
  for (int steps = 1; steps <= kWidestGap; ++steps) {
    const Cell seen = at(moved(cell, step, steps));
    if (seen == Cell::kWall) return steps;
    if (seen == Cell::kFree) return 0;
  }
  return 0;
}

}  // namespace lstm_planner
