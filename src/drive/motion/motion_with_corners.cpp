#include <algorithm>
#include <cmath>

#include "drive/motion/motion_parts.hpp"
#include "lstm_planner/common/arc.hpp"

namespace lstm_planner {

namespace {

constexpr double kStillSpeed = 0.01;  // m/s; an odometry may say so of a robot that stands
constexpr double kCreeping = 0.05;    // m/s, of the fastest wheel, where less than the safety margin is kept
constexpr double kSlowest = 0.05;     // m/s; a robot that may only go slower than this rather turns in place
constexpr double kTurnSlack = 0.02;   // rad of an angle to turn by that need not be free
constexpr double kLeastTurn = 0.05;   // rad that are worth a turn
constexpr double kSlowestTurn = 0.1;  // rad/s; slower is standing
constexpr double kTurnsOnly = 0.01;   // m; a path back that is shorter is a turn in place
constexpr double kArcRadius = 0.4;    // m; on a narrower arc back the heading matters more than the place
constexpr double kFastestBack = 0.2;  // m/s; faster it would leave the path that it came before it sees that
constexpr double kShares[] = {1.0, 0.75, 0.5, 0.35, 0.2, 0.1, 0.05};
constexpr double kNarrower[] = {0.7, 0.45, 0.2, 0.0};

double slowSpeed(const MotionParameters& parameters) { return std::min(parameters.slow_speed, parameters.max_linear); }

/// The fastest share of a motion that `isFine(twist)`, none where not even the slowest is.
template <typename IsFine>
std::optional<Twist2> fastestShare(const Twist2& wanted, IsFine&& isFine) {
  for (const double share : kShares) {
    const Twist2 twist{share * wanted.linear, share * wanted.angular};
    if (isFine(twist)) return twist;
  }
  return std::nullopt;
}

/// The measured motion without its noise: who stands must not be stopped by it.
Twist2 goingOn(const Twist2& current) {
  return {std::abs(current.linear) < kStillSpeed ? 0.0 : current.linear, current.angular};
}

/// Whether commands to drive that way, 1 or -1, are still on their way.
bool isTold(const MotionHistory& history, double way) {
  return std::any_of(history.commanded.begin(), history.commanded.end(),
                     [way](const Twist2& twist) { return way * twist.linear > 0.0; });
}

}  // namespace

/// No motion leaves without having been looked at, whoever decided it.
MotionCommand MotionController::checked(const MotionCommand& command, const Moment& now) const {
  MotionCommand answer = command;
  if (now.margin < parameters_.safety_margin) {
    const double rim = std::abs(command.linear) + 0.5 * parameters_.axle_length * std::abs(command.angular);
    const double share = rim > kCreeping ? kCreeping / rim : 1.0;
    answer.linear *= share;
    answer.angular *= share;
  }
  const double margin = command.goes_back ? kLeastMargin * parameters_.safety_margin : now.margin;
  const bool stands = answer.linear == 0.0 && answer.angular == 0.0;
  if (!stands && SafeMotion(*this, now, now.history, margin)(answer)) return answer;
  return {{}, command.stop == StopReason::kNone ? StopReason::kObstacle : command.stop};
}

MotionCommand MotionController::driveWithCorners(const Twist2& wanted, double error, const Moment& now) const {
  StopReason stop = StopReason::kNone;
  const bool heads_there = std::abs(error) < kLeastTurn;
  if (now.history.goes_back && !heads_there) return makeRoom(error, now);
  const double speed = fastest(wanted, now, &stop);
  const bool drives = speed >= kSlowest || (speed >= kCreep && speed >= wanted.linear - kCreep);
  if (drives) return {withinWheelLimits({speed, wanted.angular}), stop};
  if (stop == StopReason::kPerson || heads_there) return {{}, stop};
  return turnWithCorners(error, now);
}

MotionCommand MotionController::turnWithCorners(double error, const Moment& now) const {
  const double turning = yieldingTurn(now.persons);
  if (turning < kSlowestTurn) return {{}, StopReason::kPerson};
  const double room = now.shield.freeTurn({}, error, now.margin);
  if (room >= std::abs(error) - kTurnSlack) return {{0.0, turningSpeed(error, now)}, StopReason::kNone};
  const double other = error - std::copysign(2.0 * M_PI, error);
  if (now.shield.freeTurn({}, other, now.margin) >= std::abs(other) - kTurnSlack) {
    return {{0.0, turningSpeed(other, now)}, StopReason::kNone};
  }
  if (!now.history.goes_back && std::abs(error) < M_PI_2) {
    const double angular = clampMagnitude(parameters_.heading_gain * error, parameters_.max_angular);
    for (const double share : kNarrower) {
      StopReason stop = StopReason::kNone;
      const Twist2 arc{slowSpeed(parameters_), share * angular};
      const double speed = fastest(arc, now, &stop);
      if (stop == StopReason::kPerson) return {{}, stop};
      if (speed >= kSlowest) return {withinWheelLimits({speed, arc.angular}), stop};
    }
  }
  return makeRoom(error, now);
}

MotionCommand MotionController::makeRoom(double error, const Moment& now) const {
  const double room = now.shield.freeTurn({}, error, now.margin);
  const double turn = room >= kLeastTurn ? turningSpeed(std::copysign(room, error), now) : 0.0;
  // Room for a turn that is not safe at any speed is none: who took it for some would go back and stand in turns.
  // Who turns by a part, in a passage, is wedged in and cannot go farther back.
  const bool can_turn = turn != 0.0 && room >= std::abs(error) - kTurnSlack;
  // Behind it somebody may have come to where the robot was.
  if (now.persons.near) return {{}, StopReason::kPerson};
  if (!now.history.goes_back || !can_turn) {
    if (const std::optional<MotionCommand> back = goBack(now)) return *back;
  }
  if (turn != 0.0) return {{0.0, turn}, StopReason::kNone};
  // It stands before it changes its way: what is hardly safe is not safe every time, and it would shake.
  if (isTold(now.history, -1.0)) return {{}, StopReason::kObstacle};
  SafeMotion isSafe(*this, now, now.history, now.margin);
  const auto out = fastestShare({slowSpeed(parameters_), 0.0}, [&](const Twist2& twist) {
    return yieldingSpeed(twist, now.persons) >= twist.linear && isSafe(twist);
  });
  return out ? MotionCommand{*out, StopReason::kNone} : MotionCommand{{}, StopReason::kObstacle};
}

std::optional<MotionCommand> MotionController::goBack(const Moment& now) const {
  if (!now.history.back) return std::nullopt;
  const Pose2& back = *now.history.back;
  const Twist2 wanted = twistTo(back);
  if (isTold(now.history, wanted.linear > 0.0 ? -1.0 : 1.0)) return MotionCommand{{}, StopReason::kObstacle, true};
  const double away = std::hypot(back.x, back.y);
  SafeMotion isSafe(*this, now, now.history, kLeastMargin * parameters_.safety_margin);  // it was there already
  const auto twist = fastestShare(wanted, [&](const Twist2& share) {
    const Twist2 limited = withinWheelLimits(share);
    // Not beyond that place: it came there from elsewhere.
    const double length = std::abs(limited.linear) * (reaction_time_ + 0.5 * brakingTime(limited));
    return length <= away + kTurnsOnly && isSafe(limited);
  });
  if (!twist) return std::nullopt;
  return MotionCommand{withinWheelLimits(*twist), StopReason::kNone, true};
}

/// Towards a pose of the trail (base frame), backwards or, where the robot had gone back, forwards.
Twist2 MotionController::twistTo(const Pose2& place) const {
  const double turn = normalizeAngle(place.yaw);
  const double away = std::hypot(place.x, place.y);
  // The arc that ends with that heading is so long.
  const double along = place.x * std::cos(0.5 * turn) + place.y * std::sin(0.5 * turn);
  const double fastest = std::min(slowSpeed(parameters_), kFastestBack);
  if (std::abs(along) >= kTurnsOnly && std::abs(along) >= kArcRadius * std::abs(turn)) {
    // The arc that leads there ends with about the heading that the robot had there.
    const double linear = std::copysign(fastest, along);
    return {linear, clampMagnitude(linear * 2.0 * place.y / (away * away), parameters_.max_angular)};
  }
  const double time = std::max(
      {std::abs(along) / fastest, 2.0 * std::abs(turn) / parameters_.max_angular, 1.0 / parameters_.heading_gain});
  return {std::abs(along) < kTurnsOnly ? 0.0 : along / time, turn / time};
}

double MotionController::turningSpeed(double angle, const Moment& now) const {
  const double most = std::min(parameters_.max_angular, yieldingTurn(now.persons));
  const double wanted = clampMagnitude(parameters_.heading_gain * angle, most);
  const auto twist = fastestShare({0.0, wanted}, SafeMotion(*this, now, now.history, now.margin));
  return twist ? twist->angular : 0.0;
}

/// Its corners must stand before somebody can reach them.
double MotionController::yieldingTurn(const Persons& persons) const {
  const Footprint& footprint = persons.moving.footprint();
  const double sweep = footprint.circumscribedRadius() - footprint.inscribedRadius();
  const double gap = persons.moving.gap({}) - sweep - parameters_.person_margin;
  const double time = gap / parameters_.person_speed - reaction_time_;
  return std::max(0.0, time * parameters_.linear_acceleration / (0.5 * parameters_.axle_length));
}

double MotionController::fastest(const Twist2& wanted, const Moment& now, StopReason* stop) const {
  const double cautious = std::min(wanted.linear, cautiousSpeed(wanted, now.shield));
  *stop = cautious < wanted.linear ? StopReason::kObstacle : StopReason::kNone;
  SafeMotion isSafe(*this, now, now.history, now.margin);
  for (const double share : kShares) {
    const Twist2 twist{share * cautious, wanted.angular};
    if (twist.linear < kCreep) break;
    const double before_persons = yieldingSpeed(twist, now.persons);
    if (before_persons < twist.linear) {
      *stop = StopReason::kPerson;
    } else if (isSafe(withinWheelLimits(twist))) {
      return twist.linear;
    } else {
      *stop = StopReason::kObstacle;
    }
  }
  return 0.0;
}

double MotionController::brakingTime(const Twist2& twist) const {
  const double rim = std::abs(twist.linear) + 0.5 * parameters_.axle_length * std::abs(twist.angular);
  return rim / parameters_.linear_acceleration;
}

MotionController::SafeMotion::SafeMotion(const MotionController& controller, const MotionSituation& situation,
                                         const MotionHistory& history, double margin)
    : controller_(controller),
      situation_(situation),
      margin_(margin),
      delay_(std::max(0.0, controller.reaction_time_ - situation.period)),
      later_(alongTurn({}, situation.current.linear * delay_, situation.current.angular * delay_)),
      can_go_on_(isFree({}, goingOn(situation.current), delay_)),
      wheels_(controller.parameters_, situation, history, controller.reaction_time_, margin) {}

bool MotionController::SafeMotion::operator()(const Twist2& twist) {
  // The robot may go on as it does now until the last moment.
  if (!can_go_on_) return false;
  const double reaction_time = controller_.reaction_time_;
  const double braking_time = 0.5 * controller_.brakingTime(twist);
  if (!isFree(later_, twist, reaction_time - delay_ + braking_time)) return false;
  // Or the command acts at once: a higher present speed is then braked away along the new arc.
  const double faster = std::max(0.0, std::abs(situation_.current.linear) + kSpeedError - std::abs(twist.linear));
  const double longer = twist.linear == 0.0 ? 0.0 : faster / std::abs(twist.linear);
  if (!isFree({}, twist, (1.0 + longer) * reaction_time + braking_time)) return false;
  return wheels_.free(twist) == WheelMotion::kFree;
}

bool MotionController::SafeMotion::isFree(const Pose2& from, const Twist2& twist, double time) const {
  const double length = twist.linear * time;
  const double angle = twist.angular * time;
  if (std::abs(length) < kSlack) {
    return std::abs(angle) < kSlack || situation_.shield.freeTurn(from, angle, margin_) >= std::abs(angle) - kSlack;
  }
  const double free = situation_.shield.freeArc(from, twist.angular / twist.linear, length, margin_);
  return free >= std::abs(length) - kSlack;
}

}  // namespace lstm_planner
