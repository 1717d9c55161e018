#include "lstm_planner/grid_world/agent/greedy_agent.hpp"

#include "lstm_planner/grid_world/search/exact_octile.hpp"

namespace lstm_planner {

int GreedyAgent::decide() {
  int best = kNoPath;
  OctileDistance best_distance;
  for (int direction = 0; direction < kGridMoveCount; ++direction) {
    if (!movePossible(observation_.ranges, direction, corner_cutting_)) continue;
    const OctileDistance distance = octileDistance(cellBeside(observation_.cell, direction), observation_.goal);
    if (best == kNoPath || distance < best_distance) {
      best = direction;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace lstm_planner
