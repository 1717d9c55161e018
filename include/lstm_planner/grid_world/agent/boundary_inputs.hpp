#pragma once

#include <array>

#include "lstm_planner/grid_world/agent/boundary_memory.hpp"

namespace lstm_planner {

/// What the memory of the boundary tells a network, within [-1, 1]; a leg of the walk and a length as logarithms.
struct BoundaryInputs {
  /// Ray by ray.
  enum RayFeature {
    kLeftHand,   ///< 1: where the left hand on the wall leads
    kRightHand,  ///< 1: where the right hand leads
    kNearer,     ///< how much nearer to the goal than ever before the ray leads
    kOwnEnd,     ///< 1: on the trail to the end of the hand that the agent keeps on the wall
    kOtherEnd,   ///< 1: on the trail to the other end
    kRayFeatures
  };
  enum Scalar { kHand, kReturning, kLeg, kOwnLength, kOtherLength, kPathBack, kOtherFarther, kScalars };

  std::array<std::array<float, kGridRayCount>, kRayFeatures> rays{};
  std::array<float, kScalars> scalars{};

  BoundaryInputs() = default;
  BoundaryInputs(const BoundaryMemory& memory, const GridObservation& observation);

  static constexpr int kCount = kRayFeatures * kGridRayCount + kScalars;

 private:
  void markRay(RayFeature feature, int direction);
};

}  // namespace lstm_planner
