#pragma once

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// A localisation that finds the robot from time to time, and corrects what odometry says by a jump.
class Localiser {
 public:
  /// `start`: where odometry starts, in the world. `jump`: m, how wrong the believed position may become before it is
  /// corrected to the true pose; 0: it is never corrected.
  Localiser(const Pose2& start, double jump) : world_from_start_(start), jump_(jump) {}

  /// Looks where the robot truly is (world), and what odometry says.
  void localise(const Pose2& true_pose, const Pose2& odometry) {
    if (jump_ <= 0.0) return;
    const Pose2 true_from_start = compose(inverse(world_from_start_), true_pose);
    if (distanceBetween(correct(odometry), true_from_start) < jump_) return;
    start_from_odometry_ = compose(true_from_start, inverse(odometry));
  }

  /// The odometry frame as it is corrected now, as a pose in the frame that odometry had at the start.
  const Pose2& correction() const { return start_from_odometry_; }

  /// A pose in the odometry frame, as it was corrected last; in the frame that odometry had at the start.
  Pose2 correct(const Pose2& odometry) const {
    return jump_ > 0.0 ? compose(start_from_odometry_, odometry) : odometry;
  }

 private:
  Pose2 world_from_start_;
  double jump_;
  Pose2 start_from_odometry_;  ///< none: odometry as it is
};

}  // namespace lstm_planner
