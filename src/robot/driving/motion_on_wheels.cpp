#include <algorithm>
#include <cmath>
#include <limits>

#include "lstm_planner/base/common/arc.hpp"
#include "robot/driving/motion_parts.hpp"

namespace lstm_planner {

namespace {

constexpr double kPiece = 0.05;     // s for which the wheels are taken to turn evenly
constexpr double kStanding = 0.01;  // m/s
constexpr double kMargin = 0.5;     // of the safety margin, which is also for what cannot be foreseen

/// Speeds of the wheels, m/s.
struct Wheels {
  Wheels(const Twist2& twist, double axle)
      : left(twist.linear - 0.5 * axle * twist.angular), right(twist.linear + 0.5 * axle * twist.angular) {}
  void approach(const Wheels& wanted, double change) {
    left += clampMagnitude(wanted.left - left, change);
    right += clampMagnitude(wanted.right - right, change);
  }
  double linear() const { return 0.5 * (left + right); }
  double left;
  double right;
};

constexpr double kFree = std::numeric_limits<double>::infinity();

}  // namespace

/// A command to a circle, such that it is free where the robot really goes: while one wheel brakes and the other one
/// speeds up to turn it, the robot does not become slower. Where it is not, the robot turns less, then brakes.
Twist2 MotionController::steadied(const Twist2& twist, const Moment& now) const {
  const double delay = std::max(0.0, reaction_time_ - now.period);
  const auto freeOf = [&](const Twist2& command) {
    return std::min(freeOnWheels(command, 0.0, now), freeOnWheels(command, delay, now));
  };
  Twist2 best = twist;
  double farthest = freeOf(twist);
  const auto tryCommand = [&](const Twist2& command) {
    if (farthest == kFree) return;
    const double free = freeOf(command);
    if (free <= farthest) return;
    farthest = free;
    best = command;
  };
  // The robot may turn faster than it may be told to, as when somebody turns it.
  const double before = clampMagnitude(now.history.commanded.value_or(now.current).angular, parameters_.max_angular);
  for (const double linear : {twist.linear, 0.0}) {
    if (linear > 0.0 && now.persons.near) continue;  // on another arc it would have to yield anew
    for (const double share : {0.5, 0.25, 0.0}) tryCommand({linear, before + share * (twist.angular - before)});
  }
  tryCommand({});
  return best;
}

/// m that it gets if for `delay` s it still obeys the command before, then this one until the next, and then brakes;
/// infinite if it gets to where it stands.
double MotionController::freeOnWheels(const Twist2& twist, double delay, const Moment& now) const {
  const double speed = std::max(0.0, now.current.linear);
  const double hold = reaction_time_ - std::max(0.0, reaction_time_ - now.period);
  const double fastest = std::max({speed, twist.linear, now.history.commanded ? now.history.commanded->linear : 0.0});
  const double margin = kMargin * parameters_.safety_margin;
  const double acceleration = parameters_.linear_acceleration;
  const double longest = fastest * (delay + hold + fastest / acceleration);
  if (now.shield.gap({}) > longest + margin) return kFree;
  Pose2 pose;
  double free = 0.0;
  const auto go = [&](double linear, double angular) {
    const double length = std::max(0.0, linear * kPiece);
    if (length == 0.0) {
      pose.yaw += angular * kPiece;
      return true;
    }
    const double here = now.shield.freeArc(pose, angular / linear, length, margin);
    free += here;
    pose = alongTurn(pose, length, angular * kPiece);
    return here >= length - kSlack;
  };
  const double axle = parameters_.axle_length;
  Wheels wheels({speed, now.current.angular}, axle);
  const Wheels before(now.history.commanded.value_or(Twist2{speed, now.current.angular}), axle);
  const Wheels command(twist, axle);
  const Wheels standing({}, axle);
  for (double time = 0.0; time < delay + hold || wheels.linear() > kStanding; time += kPiece) {
    const Wheels& wanted = time < delay ? before : (time < delay + hold ? command : standing);
    wheels.approach(wanted, acceleration * kPiece);
    if (!go(wheels.linear(), (wheels.right - wheels.left) / axle)) return free;
  }
  return kFree;
}

}  // namespace lstm_planner
