#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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

/// Where the wheels really take the robot: on as it was told before until a command acts, which may be at once or after
/// a delay, then along the command until the next one, and then braking. The controller must outlive it.
class MotionController::WheelMotion {
 public:
  WheelMotion(const MotionController& controller, const Moment& now)
      : parameters_(controller.parameters_),
        shield_(now.shield),
        acceleration_(parameters_.wheel_acceleration > 0.0 ? parameters_.wheel_acceleration
                                                           : parameters_.linear_acceleration),
        gap_(now.shield.gap({})),
        margin_(kMargin * parameters_.safety_margin),
        delay_(std::max(0.0, controller.reaction_time_ - now.period)),
        hold_(controller.reaction_time_ - delay_),
        current_{std::max(0.0, now.current.linear), now.current.angular},
        before_(now.history.commanded.value_or(current_)) {}

  /// m that it gets; infinite if it gets to where it stands.
  double free(const Twist2& command) {
    const double at_once = freeAfter(0.0, command);
    return delay_ > 0.0 ? std::min(at_once, freeAfter(delay_, command)) : at_once;
  }

 private:
  struct Rolling {
    Wheels wheels;
    Pose2 pose;           ///< base frame of now
    double time = 0.0;    ///< s from now
    double free = 0.0;    ///< m it got
    bool is_free = true;  ///< up to here
  };

  double freeAfter(double delay, const Twist2& command) {
    const double fastest = std::max({current_.linear, command.linear, before_.linear});
    const double longest = fastest * (delay + hold_ + fastest / acceleration_);
    if (gap_ > longest + margin_) return kFree;
    Rolling rolling = delay > 0.0 ? whenDelayed() : atOnce();
    const Wheels wanted(command, parameters_.axle_length);
    while (rolling.is_free && rolling.time < delay + hold_) roll(wanted, &rolling);
    const Wheels standing({}, parameters_.axle_length);
    while (rolling.is_free && rolling.wheels.linear() > kStanding) roll(standing, &rolling);
    return rolling.is_free ? kFree : rolling.free;
  }

  Rolling atOnce() const { return {Wheels(current_, parameters_.axle_length), {}}; }

  /// The same for all commands.
  const Rolling& whenDelayed() {
    if (!delayed_) {
      delayed_ = atOnce();
      const Wheels before(before_, parameters_.axle_length);
      while (delayed_->is_free && delayed_->time < delay_) roll(before, &*delayed_);
    }
    return *delayed_;
  }

  /// One piece on.
  void roll(const Wheels& wanted, Rolling* rolling) const {
    rolling->wheels.approach(wanted, acceleration_ * kPiece);
    rolling->time += kPiece;
    const double linear = rolling->wheels.linear();
    const double angular = (rolling->wheels.right - rolling->wheels.left) / parameters_.axle_length;
    const double length = std::max(0.0, linear * kPiece);
    if (length == 0.0) {
      rolling->pose.yaw += angular * kPiece;
      return;
    }
    const double free = shield_.freeArc(rolling->pose, angular / linear, length, margin_);
    rolling->free += free;
    rolling->pose = alongTurn(rolling->pose, length, angular * kPiece);
    rolling->is_free = free >= length - kSlack;
  }

  const MotionParameters& parameters_;
  const Shield& shield_;
  double acceleration_;  ///< m/s^2, of a wheel
  double gap_;           ///< m
  double margin_;        ///< m
  double delay_;         ///< s
  double hold_;          ///< s, until the next command acts
  Twist2 current_;
  Twist2 before_;
  std::optional<Rolling> delayed_;
};

/// A command to a circle, such that it is free where the robot really goes: while one wheel brakes and the other one
/// speeds up to turn it, the robot does not become slower. Where it is not, the robot turns less, then brakes.
Twist2 MotionController::steadied(const Twist2& twist, const Moment& now) const {
  WheelMotion motion(*this, now);
  Twist2 best = twist;
  double farthest = motion.free(twist);
  const auto tryCommand = [&](const Twist2& command) {
    if (farthest == kFree) return;
    const double free = motion.free(command);
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

}  // namespace lstm_planner
