#include "drive/motion/wheel_motion.hpp"

#include <algorithm>
#include <cmath>

#include "drive/motion/motion_parts.hpp"
#include "lstm_planner/common/arc.hpp"

namespace lstm_planner {

namespace {

constexpr double kPiece = 0.025;    // s for which the wheels are taken to turn evenly
constexpr double kStanding = 0.01;  // m/s
constexpr double kFastest = 20.0;   // m/s; an odometry that says more is wrong, and braking from it is long to compute

}  // namespace

WheelMotion::WheelMotion(const MotionParameters& parameters, const MotionSituation& situation,
                         const MotionHistory& history, double reaction_time, double margin)
    : parameters_(parameters),
      shield_(situation.shield),
      history_(history),
      acceleration_(parameters.wheel_acceleration > 0.0 ? parameters.wheel_acceleration
                                                        : parameters.linear_acceleration),
      period_(situation.period),
      delay_(std::max(0.0, reaction_time - period_)),
      hold_(reaction_time - delay_),
      margin_(margin),
      gap_(situation.shield.gap({})),
      current_(situation.current) {
  // A circle never drives backwards.
  if (shield_.footprint().isCircle()) current_.linear = std::max(0.0, current_.linear);
  const double share = kFastest / std::max(kFastest, rim(current_));
  current_ = {share * current_.linear, share * current_.angular};
}

double WheelMotion::free(const Twist2& command) {
  if (begins_.empty()) {
    for (double delay = 0.0; delay < delay_ - kSlack; delay += period_) begins_.push_back(begin(delay));
    begins_.push_back(begin(delay_));
  }
  double least = kFree;
  for (const Rolling& rolling : begins_) least = std::min(least, freeFrom(rolling, command));
  return least;
}

/// Until a command acts, which takes so long, s: the ones before it take as long.
WheelMotion::Rolling WheelMotion::begin(double delay) const {
  Rolling rolling{wheelsAt(current_), {}};
  while (rolling.is_free && rolling.time < delay - kSlack) roll(onItsWay(delay - rolling.time), &rolling);
  return rolling;
}

/// What acts on the wheels when a command needs that long yet, s.
const Twist2& WheelMotion::onItsWay(double left) const {
  const auto periods_ago = static_cast<std::size_t>(std::ceil(left / period_ - kSlack));
  const std::vector<Twist2>& commanded = history_.commanded;
  if (commanded.empty() || periods_ago == 0) return current_;
  return commanded[commanded.size() - std::min(periods_ago, commanded.size())];
}

double WheelMotion::freeFrom(Rolling rolling, const Twist2& command) const {
  const double end = rolling.time + hold_;
  double fastest = std::max(rim(current_), rim(command));
  for (const Twist2& before : history_.commanded) fastest = std::max(fastest, rim(before));
  if (gap_ > fastest * (end + fastest / acceleration_) + margin_) return kFree;
  while (rolling.is_free && rolling.time < end - kSlack) roll(command, &rolling);
  const auto rolls = [&] {
    return std::max(std::abs(rolling.wheels.left), std::abs(rolling.wheels.right)) > kStanding;
  };
  while (rolling.is_free && rolls()) roll({}, &rolling);
  return rolling.is_free ? kFree : rolling.free;
}

/// One piece on.
void WheelMotion::roll(const Twist2& wanted, Rolling* rolling) const {
  const Wheels target = wheelsAt(wanted);
  const double change = acceleration_ * kPiece;
  Wheels& wheels = rolling->wheels;
  const Wheels before = wheels;
  wheels.left += clampMagnitude(target.left - wheels.left, change);
  wheels.right += clampMagnitude(target.right - wheels.right, change);
  const double left = 0.5 * (before.left + wheels.left) * kPiece;
  const double right = 0.5 * (before.right + wheels.right) * kPiece;
  const double length = 0.5 * (left + right);
  const double turn = (right - left) / parameters_.axle_length;
  rolling->time += kPiece;
  const double share = freeOnArc(rolling->pose, length, turn);
  rolling->free += share * std::abs(length);
  rolling->is_free = share >= 1.0;
  rolling->pose = alongTurn(rolling->pose, length, turn);
}

/// The share of that arc that is free.
double WheelMotion::freeOnArc(const Pose2& from, double length, double turn) const {
  const double way = std::abs(length);
  if (length < 0.0 && shield_.footprint().isCircle()) return 1.0;  // it is about to stand
  if (way < kSlack) {
    const double angle = std::abs(turn);
    const double free = angle < kSlack ? angle : shield_.freeTurn(from, turn, margin_);
    return free >= angle - kSlack ? 1.0 : free / angle;
  }
  const double free = shield_.freeArc(from, turn / length, length, margin_);
  return free >= way - kSlack ? 1.0 : free / way;
}

WheelMotion::Wheels WheelMotion::wheelsAt(const Twist2& twist) const {
  const double half = 0.5 * parameters_.axle_length * twist.angular;
  return {twist.linear - half, twist.linear + half};
}

/// m/s, of the point of the footprint that moves fastest, or of a wheel.
double WheelMotion::rim(const Twist2& twist) const {
  const double reach = shield_.footprint().isCircle() ? 0.0 : shield_.footprintRadius();
  return std::abs(twist.linear) + std::max(0.5 * parameters_.axle_length, reach) * std::abs(twist.angular);
}

}  // namespace lstm_planner
