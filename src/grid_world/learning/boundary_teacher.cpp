#include "grid_world/learning/boundary_teacher.hpp"

#include "lstm_planner/grid_world/agent/nearer_cell.hpp"

namespace lstm_planner {
namespace {

int directionAlongBoundary(const BoundaryMemory& memory, const GridObservation& observation,
                           const BoundaryParameters& parameters) {
  if (!memory.hand()) return memory.directionByHand(firstWallSide(observation, directionOfObstacle(observation)));
  const WallSide hand = *memory.hand();
  if (memory.returning()) return memory.directionToEnd(hand);
  const int back = memory.directionToEnd(opposite(hand));
  const bool turns_back =
      back != kNoPath && parameters.turnsBack(memory.leg(), memory.pathBack(), memory.otherEndFarther());
  return turns_back ? back : memory.directionByHand(hand);
}

}  // namespace

int taughtMove(const BoundaryMemory& memory, const GridObservation& observation, const BoundaryParameters& parameters) {
  int direction = directionToNearerNeighbour(observation, memory.best(), parameters.corner_cutting);
  if (direction == kNoPath) direction = directionToNearerCell(observation, memory.best());
  if (direction == kNoPath) direction = directionAlongBoundary(memory, observation, parameters);
  if (direction != kNoPath) return direction;
  // Without a wall at the hand: towards the goal, where the boundary is.
  constexpr OctileDistance kAny{std::int64_t{1} << 29, 0};
  return directionToNearerNeighbour(observation, kAny, parameters.corner_cutting);
}

}  // namespace lstm_planner
