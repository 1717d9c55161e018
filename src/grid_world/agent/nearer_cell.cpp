#include "grid_world/agent/nearer_cell.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace lstm_planner {
namespace {

int rangeOf(const GridObservation& observation, int direction) {
  return observation.ranges[static_cast<std::size_t>(direction)];
}

/// How many steps ahead along a straight ray the cell lies that is nearest to the goal, as far as the ray is free.
int stepsToNearestCell(const GridObservation& observation, int direction) {
  const CellIndex step = kGridRaySteps[static_cast<std::size_t>(direction)];
  // Going straight, the distance falls until abreast of the goal and grows from there on.
  const int abreast = (observation.goal.column - observation.cell.column) * step.column +
                      (observation.goal.row - observation.cell.row) * step.row;
  return std::clamp(abreast, 0, rangeOf(observation, direction) - 1);
}

}  // namespace

int directionToNearerNeighbour(const GridObservation& observation, OctileDistance best, CornerCutting corner_cutting) {
  const OctileDistance distance = octileDistance(observation.cell, observation.goal);
  OctileDistance nearest = best;
  int found = kNoPath;
  std::int64_t longest = 0;
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    if (!movePossible(observation.ranges, direction, corner_cutting)) continue;
    const OctileDistance next = octileDistance(cellBeside(observation.cell, direction), observation.goal);
    if (!(next < best)) continue;
    // Of the two directions of a shortest path, if both are possible, the one that can be kept for longer.
    const bool diagonal = direction % 2 != 0;
    if (next == (diagonal ? OctileDistance{distance.straight, distance.diagonal - 1}
                          : OctileDistance{distance.straight - 1, distance.diagonal})) {
      const std::int64_t needed = diagonal ? distance.diagonal : distance.straight;
      const std::int64_t open = std::min<std::int64_t>(needed, rangeOf(observation, direction) - 1);
      if (open > longest) {
        longest = open;
        found = direction;
      }
    } else if (longest == 0 && next < nearest) {
      nearest = next;
      found = direction;
    }
  }
  return found;
}

int openSteps(const GridObservation& observation, int direction, CornerCutting corner_cutting) {
  const bool passes_corners = direction % 2 == 0 || corner_cutting == CornerCutting::kAllowed;
  if (passes_corners) return rangeOf(observation, direction) - 1;
  return movePossible(observation.ranges, direction, corner_cutting) ? 1 : 0;
}

int directionToNearerCell(const GridObservation& observation, OctileDistance best) {
  int found = kNoPath;
  int fewest = 0;
  for (int direction = 0; direction < kGridRayCount; direction += 2) {
    const int steps = stepsToNearestCell(observation, direction);
    if (steps < 1 || (found != kNoPath && steps >= fewest)) continue;
    const CellIndex seen = alongRay(observation.cell, static_cast<std::size_t>(direction), steps);
    if (!(octileDistance(seen, observation.goal) < best)) continue;
    fewest = steps;
    found = direction;
  }
  return found;
}

int directionOfObstacle(const GridObservation& observation) {
  const int columns = observation.goal.column - observation.cell.column;
  const int rows = observation.goal.row - observation.cell.row;
  if (std::abs(columns) >= std::abs(rows)) return columns > 0 ? 0 : 4;
  return rows > 0 ? 2 : 6;
}

WallSide firstWallSide(const GridObservation& observation, int obstacle) {
  const auto range = [&](int turn) { return rangeOf(observation, turned(obstacle, turn)); };
  return range(2) >= range(6) ? WallSide::kRight : WallSide::kLeft;
}

}  // namespace lstm_planner
