#include "lstm_planner/grid_world/agent/boundary_inputs.hpp"

#include <algorithm>
#include <cmath>

#include "grid_world/agent/along_ray.hpp"
#include "lstm_planner/grid_world/agent/nearer_cell.hpp"

namespace lstm_planner {
namespace {

constexpr double kNearerScale = 2.0;  ///< cells
constexpr double kFartherScale = 16.0;
constexpr double kMostLogCells = 10.0;  ///< log2 of the longest way that is told apart

float logarithmic(double cells) {
  return static_cast<float>(std::min(1.0, std::log2(1.0 + std::max(0.0, cells)) / kMostLogCells));
}

float saturated(double value, double scale) { return static_cast<float>(value / (scale + std::abs(value))); }

}  // namespace

BoundaryInputs::BoundaryInputs(const BoundaryMemory& memory, const GridObservation& observation) {
  markRay(kLeftHand, memory.directionByHand(WallSide::kLeft));
  markRay(kRightHand, memory.directionByHand(WallSide::kRight));
  for (int ray = 0; ray < kGridRayCount; ++ray) {
    const int steps = stepsToNearestCell(observation, ray, memory.cornerCutting());
    const CellIndex nearest = alongRay(observation.cell, static_cast<std::size_t>(ray), steps);
    const double gain = memory.best().length() - octileDistance(nearest, observation.goal).length();
    rays[kNearer][static_cast<std::size_t>(ray)] = saturated(gain, kNearerScale);
  }
  if (!memory.hand()) return;
  const WallSide own = *memory.hand();
  const WallSide other = opposite(own);
  markRay(kOwnEnd, memory.directionToEnd(own));
  markRay(kOtherEnd, memory.directionToEnd(other));
  scalars[kHand] = own == WallSide::kLeft ? 1.0f : -1.0f;
  scalars[kReturning] = memory.returning() ? 1.0f : 0.0f;
  scalars[kLeg] = logarithmic(memory.leg());
  scalars[kOwnLength] = logarithmic(memory.lengthToEnd(own));
  scalars[kOtherLength] = logarithmic(memory.lengthToEnd(other));
  scalars[kPathBack] = logarithmic(memory.pathBack());
  scalars[kOtherFarther] = saturated(memory.otherEndFarther(), kFartherScale);
}

void BoundaryInputs::markRay(RayFeature feature, int direction) {
  if (direction != kNoPath) rays[feature][static_cast<std::size_t>(direction)] = 1.0f;
}

}  // namespace lstm_planner
