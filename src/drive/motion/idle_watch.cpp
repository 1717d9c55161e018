#include "lstm_planner/drive/motion/idle_watch.hpp"

#include <algorithm>
#include <cmath>

namespace lstm_planner {

namespace {

constexpr double kSlowestStart = 3.0;    // s
constexpr double kLongestPeriod = 0.5;   // s, that one command lasts
constexpr double kMovedAtAll = 0.02;     // m
constexpr double kTurnedAtAll = 0.05;    // rad
constexpr double kLeastSpeed = 0.03;     // m/s; motors may not turn at less
constexpr double kLeastTurnSpeed = 0.2;  // rad/s

}  // namespace

void IdleWatch::note(const Pose2& pose, double time, const Twist2& command) {
  const double passed = std::clamp(time - time_, 0.0, kLongestPeriod);
  time_ = time;
  if (is_told_) told_ += passed;
  is_told_ = std::abs(command.linear) >= kLeastSpeed || std::abs(command.angular) >= kLeastTurnSpeed;
  if (distanceBetween(pose, pose_) <= kMovedAtAll && std::abs(normalizeAngle(pose.yaw - pose_.yaw)) <= kTurnedAtAll)
    return;
  pose_ = pose;
  told_ = 0.0;
}

double IdleWatch::idle() const { return told_ > kSlowestStart ? told_ : 0.0; }

}  // namespace lstm_planner
