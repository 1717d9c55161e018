#pragma once

#include <array>

#include "lstm_planner/grid_world/agent/walk_memory.hpp"

namespace lstm_planner {

/// What the memory of the walk tells a network: which rays lead back to the start, which to places that were not
/// visited, what there is behind, and where a hand on the wall would lead. All within [-1, 1].
struct WalkInputs {
  /// Ray by ray.
  enum RayFeature { kNearer, kNearerFar, kOpening, kLeftHand, kRightHand, kRayFeatures };
  static constexpr int kScalars = 5;

  std::array<std::array<float, kGridRayCount>, kRayFeatures> rays{};
  std::array<float, kScalars> scalars{};
  float behind_cos = 0.0f;  ///< direction of the best opening behind, 0 and 0 without one
  float behind_sin = 0.0f;

  WalkInputs() = default;
  /// `previous_direction`: of the step before, -1 without one.
  WalkInputs(const WalkMemory& memory, const GridObservation& observation, int previous_direction);

 private:
  float noteRays(const WalkMemory& memory);
  void noteHands(const GridRanges& ranges, int previous_direction);
};

}  // namespace lstm_planner
