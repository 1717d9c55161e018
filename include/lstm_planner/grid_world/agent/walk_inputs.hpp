#pragma once

#include <array>

#include "lstm_planner/grid_world/agent/walk_memory.hpp"

namespace lstm_planner {

/// What the memory of the walk tells a network: which rays lead back to the start, which to places that were not
/// visited, what there is behind, and where a hand on the wall would lead. All within [-1, 1].
struct WalkInputs {
  /// Ray by ray.
  enum RayFeature { kNearer, kNearerFar, kOpening, kLeftHand, kRightHand, kRayFeatures };
  enum Scalar { kHere, kAhead, kBehind, kWalk, kCompared, kScalars };

  /// What a network is told of it.
  struct Parts {
    bool start = false;     ///< where the start is nearer, and how far it is
    bool openings = false;  ///< what was seen and not visited
    bool hands = false;     ///< where a hand on the wall would lead
    bool any() const { return start || openings || hands; }
  };

  std::array<std::array<float, kGridRayCount>, kRayFeatures> rays{};
  std::array<float, kScalars> scalars{};
  float behind_cos = 0.0f;  ///< direction of the best opening behind, 0 and 0 without one
  float behind_sin = 0.0f;

  WalkInputs() = default;
  /// `previous_direction`: of the step before, -1 without one.
  WalkInputs(const WalkMemory& memory, const GridObservation& observation, int previous_direction);

  /// Calls visit(value) for the array of a value a ray, or for each scalar, of these parts.
  template <typename Visit>
  void visitRays(const Parts& parts, const Visit& visit) const {
    for (int feature = 0; feature < kRayFeatures; ++feature) {
      if (isPartRay(parts, feature)) visit(rays[static_cast<std::size_t>(feature)]);
    }
  }
  template <typename Visit>
  void visitScalars(const Parts& parts, const Visit& visit) const {
    for (int scalar = 0; scalar < kScalars; ++scalar) {
      if (isPartScalar(parts, scalar)) visit(scalars[static_cast<std::size_t>(scalar)]);
    }
  }
  /// Number of inputs, with the direction of the best opening behind.
  static constexpr int size(const Parts& parts) {
    int inputs = parts.openings ? 2 : 0;
    for (int feature = 0; feature < kRayFeatures; ++feature) inputs += isPartRay(parts, feature) ? kGridRayCount : 0;
    for (int scalar = 0; scalar < kScalars; ++scalar) inputs += isPartScalar(parts, scalar) ? 1 : 0;
    return inputs;
  }

 private:
  static constexpr bool isPartRay(const Parts& parts, int feature) {
    if (feature == kOpening) return parts.openings;
    return feature == kLeftHand || feature == kRightHand ? parts.hands : parts.start;
  }
  static constexpr bool isPartScalar(const Parts& parts, int scalar) {
    return scalar == kHere ? parts.start : parts.openings;
  }
  float noteRays(const WalkMemory& memory);
  void noteHands(const GridRanges& ranges, int previous_direction);
};

}  // namespace lstm_planner
