#include "lstm_planner/drive/perception/correction_watch.hpp"

#include <cmath>

namespace lstm_planner {

double CorrectionWatch::note(const Pose2& odometry_frame, const Pose2& odometry) {
  const Pose2 before = odometry_frame_.value_or(odometry_frame);
  odometry_frame_ = odometry_frame;
  const double moved = distanceBetween(compose(before, odometry), compose(odometry_frame, odometry));
  const double turned = std::abs(normalizeAngle(odometry_frame.yaw - before.yaw));
  if (moved > kFarthest || turned > kMostTurned) ++jumps_;
  return moved;
}

}  // namespace lstm_planner
