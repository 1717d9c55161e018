#include "grid_world/agent/d_star_agent.hpp"

namespace lstm_planner {

DStarAgent::DStarAgent(int columns, int rows, CornerCutting corner_cutting)
    : columns_(columns), rows_(rows), corner_cutting_(corner_cutting), search_(columns, rows, {0, 0}, corner_cutting) {}

void DStarAgent::start(CellIndex start, CellIndex goal) {
  search_ = DStar(columns_, rows_, goal, corner_cutting_);
  cell_ = start;
  goal_ = goal;
}

void DStarAgent::learnRay(CellIndex cell, int direction, int range) {
  for (int step = 1; step < range; ++step) {
    cell = cellBeside(cell, direction);
    if (search_.contains(cell)) search_.setPassable(cell, true);
  }
  const CellIndex end = cellBeside(cell, direction);
  if (range < kGridRayCap && search_.contains(end)) search_.setPassable(end, false);
}

void DStarAgent::observe(const GridObservation& observation) {
  cell_ = observation.cell;
  for (int direction = 0; direction < kGridRayCount; ++direction) {
    learnRay(cell_, direction, observation.ranges[static_cast<std::size_t>(direction)]);
  }
}

int DStarAgent::decide() {
  if (cell_ == goal_ || !search_.plan(cell_)) return kNoPath;
  return search_.firstMove(cell_);
}

}  // namespace lstm_planner
