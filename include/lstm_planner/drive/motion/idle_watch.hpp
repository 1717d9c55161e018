#pragma once

#include <algorithm>
#include <cmath>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// Notices that a robot does not do what it is told: nobody hears its commands, or its motors are off.
class IdleWatch {
 public:
  /// The robot is here by its odometry at that time (s), and is given a command.
  void note(const Pose2& pose, double time, const Twist2& command) {
    const double passed = std::clamp(time - time_, 0.0, kLongestPeriod);
    time_ = time;
    if (is_told_) told_ += passed;
    is_told_ = std::abs(command.linear) >= kLeastSpeed || std::abs(command.angular) >= kLeastTurnSpeed;
    if (distanceBetween(pose, pose_) <= kMovedAtAll && turnBetween(pose, pose_) <= kTurnedAtAll) return;
    pose_ = pose;
    told_ = 0.0;
  }

  /// s for which it has been told to move since it last did; 0 as long as that is less than any base takes to start.
  double idle() const { return told_ > kSlowestStart ? told_ : 0.0; }

 private:
  static constexpr double kSlowestStart = 3.0;    // s
  static constexpr double kLongestPeriod = 0.5;   // s, that one command lasts
  static constexpr double kMovedAtAll = 0.02;     // m
  static constexpr double kTurnedAtAll = 0.05;    // rad
  static constexpr double kLeastSpeed = 0.03;     // m/s; motors may not turn at less
  static constexpr double kLeastTurnSpeed = 0.2;  // rad/s

  Pose2 pose_;  ///< when it last moved
  double time_ = 0.0;
  bool is_told_ = false;
  double told_ = 0.0;  ///< s
};

}  // namespace lstm_planner
