#include "lstm_planner/drive/perception/reach.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {

bool isInReach(const Pose2& pose) {
  return std::abs(pose.x) <= kFarthestPose && std::abs(pose.y) <= kFarthestPose && std::isfinite(pose.yaw);
}

bool isInReach(const Pose2& pose, const Point2& goal) { return distanceBetween(pose, goal) <= kFarthestGoal; }

void checkPose(const Pose2& pose) {
  if (isInReach(pose)) return;
  throw std::invalid_argument("the robot's pose in the odometry frame is (" + numberText(pose.x) + ", " +
                              numberText(pose.y) + ") m with yaw " + numberText(pose.yaw) + ", expected at most " +
                              numberText(kFarthestPose) + " m from the origin along each axis");
}

void checkGoal(const Pose2& pose, const Point2& goal) {
  if (isInReach(pose, goal)) return;
  throw std::invalid_argument("the goal is " + numberText(distanceBetween(pose, goal)) +
                              " m from the robot, expected at most " + numberText(kFarthestGoal) +
                              " m: is it given in the right frame?");
}

}  // namespace lstm_planner
