#include "lstm_planner/robot/driving/stand_watch.hpp"

#include <cmath>

namespace lstm_planner {

namespace {

constexpr double kMoved = 0.05;     // m; more than odometry's noise, less than the slowest robot drives in seconds
constexpr double kTurned = 0.3;     // rad
constexpr double kSameGoal = 0.25;  // m

}  // namespace

void StandWatch::note(const Pose2& pose, double time, const Point2& goal, bool is_commanded) {
  const bool has_left =
      distanceBetween(place_, pose) > kMoved || std::abs(normalizeAngle(pose.yaw - place_.yaw)) > kTurned;
  if (!since_ || has_left || distanceBetween(goal_, goal) > kSameGoal || time < now_) {
    place_ = pose;
    goal_ = goal;
    since_ = time;
    tried_.reset();
  }
  now_ = time;
  if (is_commanded && !tried_) tried_ = time;
}

void StandWatch::excuse(double time) {
  if (since_) since_ = time;
  tried_.reset();
}

}  // namespace lstm_planner
