#include "lstm_planner/drive/perception/reach.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace lstm_planner {

bool isInReach(const Pose2& pose) {
  return std::abs(pose.x) <= kFarthestPose && std::abs(pose.y) <= kFarthestPose && std::isfinite(pose.yaw);
}

bool isInReach(const Pose2& pose, const Point2& goal) { return distanceBetween(pose, goal) <= kFarthestGoal; }

void checkPose(const Pose2& pose) {
  if (isInReach(pose)) return;
  std::ostringstream message;
  message << "the robot's pose in the odometry frame is (" << pose.x << ", " << pose.y << ") m with yaw " << pose.yaw
          << ", expected at most " << kFarthestPose << " m from the origin along each axis";
  throw std::invalid_argument(message.str());
}

void checkGoal(const Pose2& pose, const Point2& goal) {
  if (isInReach(pose, goal)) return;
  std::ostringstream message;
  message << "the goal is " << distanceBetween(pose, goal) << " m from the robot, expected at most " << kFarthestGoal
          << " m: is it given in the right frame?";
  throw std::invalid_argument(message.str());
}

}  // namespace lstm_planner
