#pragma once

#include <algorithm>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// How far a robot that is to look around has turned. Turning to and fro counts once.
class FullTurn {
 public:
  /// It begins with this heading (rad) at that time (s).
  void start(double yaw, double time) {
    *this = {};
    yaw_ = yaw;
    since_ = now_ = time;
  }
  void note(double yaw, double time) {
    turn_ += normalizeAngle(yaw - yaw_);
    yaw_ = yaw;
    now_ = time;
    least_ = std::min(least_, turn_);
    most_ = std::max(most_, turn_);
    if (most_ - least_ < noted_ + kProgress) return;
    noted_ = most_ - least_;
    since_ = time;
  }

  /// It has seen everything around it, or turns no further: a robot with corners cannot turn everywhere.
  bool isOver() const { return most_ - least_ >= kEnough || now_ - since_ > kPatience; }

 private:
  static constexpr double kEnough = kFullTurn - 0.5;  // rad; the scanner sees more than the rest at once
  static constexpr double kProgress = 0.2;            // rad
  static constexpr double kPatience = 5.0;            // s for that progress

  double yaw_ = 0.0;    ///< rad
  double turn_ = 0.0;   ///< rad since the start, counter-clockwise
  double least_ = 0.0;  ///< rad, of turn_
  double most_ = 0.0;   ///< rad, of turn_
  double noted_ = 0.0;  ///< rad, most_ - least_ when it last made progress
  double since_ = 0.0;  ///< s, when that was
  double now_ = 0.0;    ///< s
};

}  // namespace lstm_planner
