#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/drive/decision/agent_parameters.hpp"
#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/practice/drive_course.hpp"

namespace lstm_planner {

/// How well a policy drives by itself: in StepSimulator, without escape, always by the action that it prefers.
struct DriveScore {
  int drives = 0;
  double arrival = 0.0;  ///< share of the drives
  /// Mean of best / driven path, at most 1; a drive that did not arrive counts as 0 ("success weighted by path length":
  /// Anderson et al., "On evaluation of embodied navigation agents", 2018). The best path is the teacher's, and its
  /// length the cost that the teacher gives it: a metre near a wall counts as more.
  double efficiency = 0.0;
};

/// One drive of a judgement.
struct JudgedDrive {
  int world = 0;         ///< number of the world
  std::size_t kind = 0;  ///< of world: index in DriveCourseParameters::worlds
  bool arrived = false;
  double efficiency = 0.0;  ///< best / driven path, at most 1; 0 if it did not arrive
};

/// Drives in so many worlds of a use, four drives in each, under random conditions. The same for any number of threads.
/// Throws std::invalid_argument if no path is long enough.
std::vector<JudgedDrive> judgeEach(const DrivePolicy& policy, const AgentParameters& agent,
                                   const DriveCourseParameters& course, WorldUse use, int worlds, int max_steps,
                                   std::uint64_t seed, int threads);

/// judgeEach() of a network and the shield alone in worlds for validation.
DriveScore judgeDrives(const DrivePolicy& policy, const DriveCourseParameters& course, int worlds, int max_steps,
                       std::uint64_t seed, int threads);

}  // namespace lstm_planner
