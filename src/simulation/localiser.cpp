#include "lstm_planner/simulation/localiser.hpp"

namespace lstm_planner {

void Localiser::localise(const Pose2& true_pose, const Pose2& odometry) {
  if (jump_ <= 0.0) return;
  const Pose2 true_from_start = compose(inverse(world_from_start_), true_pose);
  if (distanceBetween(correct(odometry), true_from_start) < jump_) return;
  start_from_odometry_ = compose(true_from_start, inverse(odometry));
}

Pose2 Localiser::correct(const Pose2& odometry) const {
  return jump_ > 0.0 ? compose(start_from_odometry_, odometry) : odometry;
}

}  // namespace lstm_planner
