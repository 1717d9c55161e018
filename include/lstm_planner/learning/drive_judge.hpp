#pragma once

#include <cstdint>

#include "lstm_planner/agent/drive_policy.hpp"
#include "lstm_planner/learning/drive_course.hpp"

namespace lstm_planner {

/// How well a policy drives by itself: StepDrive without escape, always the action that it prefers.
struct DriveScore {
  int drives = 0;
  double arrival = 0.0;  ///< share of the drives
  /// Mean of shortest / driven way, 0 for those that did not arrive ("success weighted by path length": Anderson et
  /// al., "On evaluation of embodied navigation agents", 2018).
  double efficiency = 0.0;
};

/// In so many worlds that are never trained on, four drives each, under random conditions. The same for any number of
/// threads.
DriveScore judgeDrives(const DrivePolicy& policy, const DriveCourseParameters& course, int worlds, int max_steps,
                       std::uint64_t seed, int threads);

}  // namespace lstm_planner
