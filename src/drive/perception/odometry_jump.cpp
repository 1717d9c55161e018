#include "lstm_planner/drive/perception/odometry_jump.hpp"

#include <algorithm>
#include <cmath>

namespace lstm_planner {

namespace {

constexpr double kLongestDrive = 1.0;   // s that a robot drives without odometry: then its controller stops it
constexpr double kJumpSlack = 0.25;     // m, what rounding and late stamps may add
constexpr double kMaxTurnRate = 6.0;    // rad/s
constexpr double kTurnJumpSlack = 0.5;  // rad

}  // namespace

bool isOdometryJump(const Pose2& from, const Pose2& to, double elapsed, double max_speed) {
  const double driven = std::min(elapsed, kLongestDrive);
  return distanceBetween(from, to) > max_speed * driven + kJumpSlack ||
         turnBetween(from, to) > kMaxTurnRate * driven + kTurnJumpSlack;
}

}  // namespace lstm_planner
