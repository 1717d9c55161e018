#include <algorithm>
#include <cmath>
#include <optional>

#include "drive/motion/evasion.hpp"
#include "drive/motion/motion_parts.hpp"

namespace lstm_planner {

namespace {

constexpr int kDirections = 24;
constexpr double kSpeeds[] = {1.0, 0.5};  // of the largest
constexpr double kRoomWeight = 10.0;      // of progress; a touch weighs more, and the later it is, the less
constexpr double kTouchWeight = 20.0;

/// The first pose of the plan that is so far from the robot (m), or its last one; base frame.
Point2 farOn(const std::vector<Pose2>& plan, const Pose2& pose, double distance) {
  const auto isFar = [&](const Pose2& place) { return distanceBetween(place, pose) >= distance; };
  const auto far = std::find_if(plan.begin(), plan.end(), isFar);
  const Pose2& place = far == plan.end() ? plan.back() : *far;
  return toLocalFrame(pose, {place.x, place.y});
}

}  // namespace

MotionCommand MotionController::evade(const MotionCommand& command, const MotionSituation& situation,
                                      const std::vector<MovingThing>& things, double free_behind,
                                      const MotionHistory& history) const {
  const auto& [plan, pose, current, shield, period] = situation;
  if (parameters_.evade_time <= 0.0 || things.empty() || plan.empty()) return command;
  if (command.stop == StopReason::kUnusableData) return command;
  const Evasion evasion(parameters_, reaction_time_, shield, things, current);
  const Outlook wanted = evasion.withCommand(command);
  if (wanted.room >= parameters_.evade_margin) return command;
  const double distance = parameters_.max_linear * parameters_.evade_time;
  const Point2 target = farOn(plan, pose, distance);
  const auto worth = [&](const Outlook& outlook) {
    return kRoomWeight * std::min(1.0, outlook.room / parameters_.evade_margin) +
           kTouchWeight * outlook.touch / parameters_.evade_time - distanceBetween(outlook.end, target) / distance;
  };
  std::optional<SafeMotion> isSafe;
  if (!shield.footprint().isCircle()) isSafe.emplace(*this, situation, history, parameters_.safety_margin);
  const auto keepsFromObstacles = [&](const Twist2& twist) {
    if (isSafe) return (*isSafe)(twist);
    return twist.linear <= 0.0 || allowedSpeed(twist, situation) >= twist.linear;
  };
  MotionCommand best = command;
  double most = worth(wanted);
  const auto consider = [&](const Outlook& outlook) {
    const double value = worth(outlook);
    // Where it would be touched in any case it is better to stand.
    const bool is_hopeless = outlook.touch < parameters_.evade_time && outlook.first.linear != 0.0;
    const Twist2 twist = withinWheelLimits(outlook.first);
    if (value <= most || is_hopeless || !keepsFromObstacles(twist)) return;
    most = value;
    best = {twist, StopReason::kNone, twist.linear < 0.0};
  };
  consider(evasion.withCommand({}));
  for (int i = 0; i < kDirections; ++i) {
    for (const double share : kSpeeds) {
      consider(evasion.towards(2.0 * M_PI * i / kDirections - M_PI, share * parameters_.max_linear));
    }
  }
  const double margin = parameters_.safety_margin;
  const double back = shield.footprint().isCircle() ? shield.freeDistance({}, M_PI, free_behind, margin)
                                                    : shield.freeArc({}, 0.0, -free_behind, margin);
  if (back <= 0.0) return best;
  for (const double share : kSpeeds) consider(evasion.backwards(share * parameters_.max_linear, back));
  return best;
}

}  // namespace lstm_planner
