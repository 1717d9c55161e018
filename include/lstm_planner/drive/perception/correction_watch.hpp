#pragma once

#include <cmath>
#include <optional>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// Distinguishes the usual small corrections of a localisation from a jump after it was lost: after a jump, remembered
/// obstacles are in wrong places.
class CorrectionWatch {
 public:
  /// m and rad, by which one correction may move the robot; whatever moves it farther is a jump.
  static constexpr double kFarthest = 1.0;
  static constexpr double kMostTurned = 0.5;

  /// `odometry_frame`: as a pose in the corrected frame, now. `odometry`: the robot's pose in it. Returns by how many
  /// metres the robot was moved in the corrected frame because the correction changed since the last call.
  double note(const Pose2& odometry_frame, const Pose2& odometry) {
    const Pose2 before = odometry_frame_.value_or(odometry_frame);
    odometry_frame_ = odometry_frame;
    const double moved = distanceBetween(compose(before, odometry), compose(odometry_frame, odometry));
    const double turned = turnBetween(odometry_frame, before);
    if (moved > kFarthest || turned > kMostTurned) ++jumps_;
    return moved;
  }

  /// Number of jumps so far.
  long jumps() const { return jumps_; }

 private:
  std::optional<Pose2> odometry_frame_;  ///< at the last call
  long jumps_ = 0;
};

}  // namespace lstm_planner
