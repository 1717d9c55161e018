#include "lstm_planner/drive/motion/motion_controller.hpp"

#include <algorithm>
#include <cmath>

#include "drive/motion/evasion.hpp"
#include "drive/motion/motion_parts.hpp"
#include "drive/motion/wheel_motion.hpp"
#include "lstm_planner/common/arc.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"

namespace lstm_planner {

namespace {

/// m/s that the robot may be faster than it measures: encoders count whole ticks.
constexpr double kSpeedError = 0.02;

constexpr double kCreep = 0.005;  ///< m/s; slower is standing

constexpr double kBehind = 2.7;  // rad of heading error

/// m/s; up to here the robot speeds up from what it was told last, not only from what it measures: the motors of many
/// bases stand still at less.
constexpr double kStart = 0.1;

/// m/s, from which the robot speeds up.
double reached(const Twist2& measured, const MotionHistory& history) {
  const double told = history.commanded.empty() ? 0.0 : history.commanded.back().linear;
  return std::max({0.0, measured.linear, std::min(told, kStart)}) + history.short_by;
}

// Of a robot with corners.
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

// Of a robot that gets out of the way.
constexpr int kDirections = 24;
constexpr double kSpeeds[] = {1.0, 0.5};  // of the largest
constexpr double kRoomWeight = 10.0;      // of progress; a touch weighs more, and the later it is, the less
constexpr double kTouchWeight = 20.0;

/// Speed of the fastest wheel, m/s.
double fastestWheel(const MotionParameters& parameters, const Twist2& twist) {
  return std::abs(twist.linear) + 0.5 * parameters.axle_length * std::abs(twist.angular);
}

/// s
double brakingTime(const MotionParameters& parameters, const Twist2& twist) {
  return fastestWheel(parameters, twist) / parameters.linear_acceleration;
}

/// Which motions of a robot with corners, braking included, come no nearer to a return than `margin` (m). The
/// arguments must outlive it.
class SafeMotion {
 public:
  SafeMotion(const MotionParameters& parameters, double reaction_time, const MotionSituation& situation,
             const MotionHistory& history, double margin)
      : parameters_(parameters),
        reaction_time_(reaction_time),
        situation_(situation),
        margin_(margin),
        delay_(std::max(0.0, reaction_time - situation.period)),
        later_(alongTurn({}, situation.current.linear * delay_, situation.current.angular * delay_)),
        can_go_on_(isFree({}, goingOn(situation.current), delay_)),
        wheels_(parameters, situation, history, reaction_time, margin) {}

  bool operator()(const Twist2& twist) {
    // The robot may go on as it does now until the last moment.
    if (!can_go_on_) return false;
    const double braking_time = 0.5 * brakingTime(parameters_, twist);
    if (!isFree(later_, twist, reaction_time_ - delay_ + braking_time)) return false;
    // Or the command acts at once: a higher present speed is then braked away along the new arc.
    const double faster = std::max(0.0, std::abs(situation_.current.linear) + kSpeedError - std::abs(twist.linear));
    const double longer = twist.linear == 0.0 ? 0.0 : faster / std::abs(twist.linear);
    if (!isFree({}, twist, (1.0 + longer) * reaction_time_ + braking_time)) return false;
    return wheels_.free(twist) == WheelMotion::kFree;
  }

 private:
  bool isFree(const Pose2& from, const Twist2& twist, double time) const {
    const double length = twist.linear * time;
    const double angle = twist.angular * time;
    if (std::abs(length) < kSlack) {
      return std::abs(angle) < kSlack || situation_.shield.freeTurn(from, angle, margin_) >= std::abs(angle) - kSlack;
    }
    const double free = situation_.shield.freeArc(from, twist.angular / twist.linear, length, margin_);
    return free >= std::abs(length) - kSlack;
  }

  const MotionParameters& parameters_;
  double reaction_time_;  ///< s
  const MotionSituation& situation_;
  double margin_;
  double delay_;    ///< s, for which the robot may go on as it does now
  Pose2 later_;     ///< where it is then, base frame
  bool can_go_on_;  ///< until then
  WheelMotion wheels_;
};

}  // namespace

/// What moves, and what has moved and stands.
struct MotionController::Persons {
  Persons(const Footprint& footprint, double reach, const std::vector<Point2>& moving_points,
          const std::vector<Point2>& resting_points)
      : moving(footprint, 0.0, reach),
        resting(footprint, 0.0, reach),
        near(!moving_points.empty() || !resting_points.empty()) {
    moving.show(moving_points);
    resting.show(resting_points);
  }
  Shield moving;
  Shield resting;
  bool near;  ///< there is somebody
};

/// What a command depends on.
struct MotionController::Moment : MotionSituation {
  const Persons& persons;
  const MotionHistory& history;
  double margin;  ///< m, that a robot with corners keeps
};

const char* toString(StopReason reason) {
  switch (reason) {
    case StopReason::kNone:
      return "it drives";
    case StopReason::kArrived:
      return "it has arrived";
    case StopReason::kNoPlan:
      return "there is no plan to follow";
    case StopReason::kObstacle:
      return "an obstacle is within the safety margin of where it would drive";
    case StopReason::kPerson:
      return "it yields to somebody who moves, or has just moved";
    case StopReason::kStuck:
      return "it has not got away from this place for longer than patience";
    case StopReason::kIdle:
      return "it does not do what it is told";
    case StopReason::kOldPlan:
      return "the plan is too old";
    case StopReason::kUnusableData:
      return "scan, odometry or a transform cannot be used";
  }
  return "unknown";
}

void validate(const MotionParameters& parameters) {
  visitMotionParameters(parameters, RangeCheck());
  const double wheels = parameters.wheel_acceleration;
  checkParameter(wheels == 0.0 || wheels >= 0.01, "wheel_acceleration", wheels, "0 or at least 0.01");
  validate(parameters.moving);
}

MotionController::MotionController(const MotionParameters& parameters)
    : parameters_((validate(parameters), parameters)),
      reaction_time_(parameters.reaction_time),
      reaction_before_persons_(parameters.reaction_time) {}

MotionCommand MotionController::compute(const MotionSituation& situation, const std::vector<Point2>& moving,
                                        const std::vector<Point2>& resting, const MotionHistory& history) const {
  const auto& [plan, pose, current, shield, period] = situation;
  if (plan.empty()) return {{}, StopReason::kNoPlan};
  if (!isFinite(pose) || !(period >= kShortestPeriod)) return {{}, StopReason::kUnusableData};
  const Persons persons(shield.footprint(), yieldingReach(shield.footprintRadius()), moving, resting);
  const Moment now{situation, persons, history, (history.has_stood ? kNarrowMargin : 1.0) * parameters_.safety_margin};
  const MotionCommand command = choose(now, moving);
  return shield.footprint().isCircle() ? command : checked(command, now);
}

MotionCommand MotionController::choose(const Moment& now, const std::vector<Point2>& moving) const {
  const MotionSituation& situation = now;
  const auto& [plan, pose, current, shield, period] = situation;
  const Persons& persons = now.persons;
  const bool has_corners = !shield.footprint().isCircle();
  const Pose2& goal = plan.back();
  const double to_goal = distanceBetween(pose, goal);
  if (to_goal <= parameters_.position_tolerance) {
    if (goalReached(pose, goal)) return {{}, StopReason::kArrived};
    const double error = normalizeAngle(goal.yaw - pose.yaw);
    if (!std::isfinite(error)) return {{}, StopReason::kUnusableData};
    if (has_corners) return turnWithCorners(error, now);
    return {{0.0, wantedTurn(error, parameters_.max_angular)}, StopReason::kNone};
  }

  if (now.history.gets_out && !persons.near) {
    if (const std::optional<MotionCommand> back = goBack(now)) return *back;
  }
  const Pose2 ahead = target(situation);
  double error = normalizeAngle(directionTo(pose, ahead) - pose.yaw);
  if (!std::isfinite(error)) {
    return {{}, StopReason::kUnusableData};  // the plan is not finite
  }
  // What lies behind may be a little to the left now and a little to the right next time: go on turning the way we
  // turn. Only when that is fast: where commands take their time, a slow turn may be the answer to the one before last.
  const bool turns = std::abs(current.angular) > 0.5 * parameters_.max_angular;
  if (std::abs(error) > kBehind && turns && error * current.angular < 0.0) {
    error -= std::copysign(2.0 * M_PI, error);
  }
  Twist2 twist{0.0, wantedTurn(error, parameters_.max_angular)};
  StopReason stop = StopReason::kNone;
  if (std::abs(error) < parameters_.turn_in_place) {
    const double brakes = std::sqrt(2.0 * parameters_.linear_acceleration * to_goal);
    const double reachable = reached(current, now.history) + parameters_.linear_acceleration * period;
    twist.linear = std::min({parameters_.max_linear * std::cos(error), brakes, reachable});
    twist = withinWheelLimits(twist);
    if (has_corners) return driveWithCorners(twist, error, now);
    const SafeSpeed safe = safeSpeed(twist, now);
    twist.linear = safe.speed;
    stop = safe.stop;
  }
  if (has_corners) return turnWithCorners(error, now);
  // Wheels that turn the robot brake it later: before somebody it stands first, then it turns.
  if (twist.linear == 0.0 && current.linear > kSpeedError && !moving.empty()) {
    return {{}, stop == StopReason::kNone ? StopReason::kPerson : stop};
  }
  return {steadied(withinWheelLimits(twist), now), stop};
}

bool MotionController::goalReached(const Pose2& pose, const Pose2& goal) const {
  return distanceBetween(pose, goal) <= parameters_.position_tolerance &&
         (parameters_.heading_tolerance >= M_PI || turnBetween(goal, pose) <= parameters_.heading_tolerance);
}

Pose2 MotionController::target(const MotionSituation& situation) const {
  const std::vector<Pose2>& plan = situation.plan;
  const Pose2& pose = situation.pose;
  std::size_t nearest = 0;
  double nearest_distance = distanceBetween(plan[0], pose);
  // Only as long as it comes nearer, or nearly: the plan may come by here again later.
  double length = 0.0;
  for (std::size_t i = 1; i < plan.size() && length < 2.0 * parameters_.lookahead; ++i) {
    length += distanceBetween(plan[i - 1], plan[i]);
    const double distance = distanceBetween(plan[i], pose);
    if (distance < nearest_distance) {
      nearest = i;
      nearest_distance = distance;
      length = 0.0;
    }
  }
  // Of a planner that gives corners only, the one that the robot comes from does not count.
  if (nearest + 1 < plan.size()) {
    const Pose2 leg{plan[nearest].x, plan[nearest].y, directionTo(plan[nearest], plan[nearest + 1])};
    if (toLocalFrame(leg, {pose.x, pose.y}).x > parameters_.nearest_target) ++nearest;
  }
  // As far ahead as the plan leads away and one can go straight: to cut a corner must not lead into what the plan goes
  // round, and a plan that turns back is followed to where it turns.
  std::size_t ahead = nearest;
  double farthest = 0.0;
  for (std::size_t i = nearest; i < plan.size(); ++i) {
    const double distance = distanceBetween(pose, plan[i]);
    if (distance < farthest) {
      break;
    }
    const double direction = directionTo(pose, plan[i]) - pose.yaw;
    const bool needed = farthest < parameters_.nearest_target;
    if (!needed && !situation.shield.isFree({}, direction, distance, parameters_.safety_margin)) {
      break;
    }
    ahead = i;
    farthest = distance;
    if (distance >= parameters_.lookahead) {
      break;
    }
  }
  return plan[ahead];
}

double MotionController::wantedTurn(double error, double most) const {
  const double angular = clampMagnitude(headingGain(parameters_.heading_gain, reaction_time_) * error, most);
  return withinWheelLimits({0.0, angular}).angular;
}

Twist2 MotionController::withinWheelLimits(const Twist2& twist) const {
  const double fastest = fastestWheel(parameters_, twist);
  const double share = std::min(1.0, parameters_.max_wheel_speed / fastest);
  return fastest > 0.0 ? Twist2{share * twist.linear, share * twist.angular} : twist;
}

MotionController::SafeSpeed MotionController::safeSpeed(const Twist2& wanted, const Moment& now) const {
  constexpr int kTries = 8;
  double speed = std::min(wanted.linear, cautiousSpeed(wanted, now.shield));
  StopReason stop = speed < wanted.linear ? StopReason::kObstacle : StopReason::kNone;
  for (int i = 0; i < kTries && speed >= kCreep; ++i) {
    const Twist2 twist{speed, wanted.angular};
    const double before_obstacles = allowedSpeed(twist, now);
    const double before_persons = yieldingSpeed(twist, now.persons);
    const double allowed = std::min(before_obstacles, before_persons);
    if (allowed >= speed) {
      return {speed, StopReason::kNone};
    }
    // A slower robot that turns as fast takes a narrower arc, which must be looked at anew.
    speed = allowed;
    stop = before_persons < before_obstacles ? StopReason::kPerson : StopReason::kObstacle;
  }
  return {0.0, stop};
}

double MotionController::cautiousSpeed(const Twist2& twist, const Shield& shield) const {
  if (parameters_.slow_speed >= parameters_.max_linear || twist.linear <= 0.0) {
    return twist.linear;
  }
  const double now = shield.gap({});
  if (now >= parameters_.slow_gap + parameters_.lookahead) {
    return parameters_.max_linear;
  }
  const double path = stoppingDistance(parameters_.max_linear);
  const double then = std::max(0.0, shield.arcGap({}, twist.angular / twist.linear, path));
  const double nearness = std::max(0.0, 1.0 - then / parameters_.slow_gap);
  // Beside a wall that it goes along, the robot comes no nearer to it.
  const double approach = std::min(1.0, 2.0 * std::max(0.0, now - then) / path);
  return parameters_.max_linear - nearness * approach * (parameters_.max_linear - parameters_.slow_speed);
}

double MotionController::yieldingReach(double footprint_radius) const {
  const double time = reaction_before_persons_ + parameters_.max_linear / parameters_.linear_acceleration;
  return footprint_radius + stoppingDistance(parameters_.max_linear) + parameters_.person_margin +
         parameters_.person_speed * time + footprint_radius;
}

double MotionController::yieldingSpeed(const Twist2& twist, const Shield& persons) const {
  const double gap = persons.arcGap({}, twist.angular / twist.linear, stoppingDistance(twist.linear));
  const double time = (gap - parameters_.person_margin) / parameters_.person_speed;
  return std::max(0.0, (time - reaction_before_persons_) * parameters_.linear_acceleration);
}

double MotionController::yieldingSpeed(const Twist2& twist, const Persons& persons) const {
  const double beside_resting = std::max(parameters_.person_slow_speed, yieldingSpeed(twist, persons.resting));
  return std::min(beside_resting, yieldingSpeed(twist, persons.moving));
}

double MotionController::stoppingDistance(double speed) const {
  return speed * reaction_time_ + speed * speed / (2.0 * parameters_.linear_acceleration);
}

double MotionController::allowedSpeed(const Twist2& twist, const MotionSituation& situation) const {
  const Shield& shield = situation.shield;
  const double margin = parameters_.safety_margin;
  const double acceleration = parameters_.linear_acceleration;
  const double curvature = twist.angular / twist.linear;
  const double present = std::max(0.0, situation.current.linear) + kSpeedError;
  // The command may act at once: the present speed, if that is higher, is then braked away along the new arc.
  const double length =
      std::max(twist.linear, present) * reaction_time_ + twist.linear * twist.linear / (2.0 * acceleration);
  double allowed = twist.linear;
  double free = shield.freeArc({}, curvature, length, margin);
  if (free < length - kSlack) {
    const double reaction = reaction_time_;
    allowed = acceleration * (std::sqrt(reaction * reaction + 2.0 * free / acceleration) - reaction);
    if (allowed < present) {
      allowed = std::sqrt(2.0 * acceleration * std::max(0.0, free - present * reaction));
    }
  }
  // Or the robot goes on as it does now until the last moment.
  const double delay = std::max(0.0, reaction_time_ - situation.period);
  const double present_curvature = situation.current.angular / present;
  if (shield.freeArc({}, present_curvature, present * delay, margin) < present * delay - kSlack) {
    return 0.0;
  }
  const Pose2 later = alongArc({}, present_curvature, present * delay);
  const double hold = reaction_time_ - delay;
  const double rest = twist.linear * hold + twist.linear * twist.linear / (2.0 * acceleration);
  free = shield.freeArc(later, curvature, rest, margin);
  if (free < rest - kSlack) {
    allowed = std::min(allowed, acceleration * (std::sqrt(hold * hold + 2.0 * free / acceleration) - hold));
  }
  return allowed;
}

/// A command to a circle, such that it is free where the robot really goes. Where it is not, the robot turns less, then
/// brakes.
Twist2 MotionController::steadied(const Twist2& twist, const Moment& now) const {
  WheelMotion motion(parameters_, now, now.history, reaction_time_, parameters_.safety_margin);
  // The robot may turn faster than it may be told to, as when somebody turns it.
  const std::vector<Twist2>& commanded = now.history.commanded;
  const Twist2& last = commanded.empty() ? now.current : commanded.back();
  const double before = clampMagnitude(last.angular, parameters_.max_angular);
  Twist2 best;
  double farthest = -1.0;
  bool brakes = false;
  const auto tryCommand = [&](const Twist2& command) {
    if (farthest == WheelMotion::kFree) return;
    const double free = motion.free(command);
    // Where nothing is free it brakes: whoever drives or turns on for a little more air has less of it next time. Of
    // commands that are as good the last one, which turns least.
    if (free < farthest || (!brakes && free != WheelMotion::kFree)) return;
    farthest = free;
    best = command;
  };
  const auto turnLess = [&](double linear) {
    for (const double share : {0.5, 0.25, 0.0}) {
      tryCommand(withinWheelLimits({linear, before + share * (twist.angular - before)}));
    }
  };
  tryCommand(twist);
  if (twist.linear != 0.0 && !now.persons.near) turnLess(twist.linear);  // on another arc it would have to yield anew
  turnLess(0.0);
  // Wheels that all take time keep their common speed the longer the more the turn changes.
  brakes = true;
  tryCommand(withinWheelLimits({0.0, clampMagnitude(now.current.angular, parameters_.max_angular)}));
  tryCommand({});
  return best;
}

/// No motion leaves without having been looked at, whoever decided it.
MotionCommand MotionController::checked(const MotionCommand& command, const Moment& now) const {
  MotionCommand answer = command;
  if (now.margin < parameters_.safety_margin) {
    const double fastest = fastestWheel(parameters_, command);
    const double share = fastest > kCreeping ? kCreeping / fastest : 1.0;
    answer.linear *= share;
    answer.angular *= share;
  }
  const double margin = command.goes_back ? kLeastMargin * parameters_.safety_margin : now.margin;
  const bool stands = answer.linear == 0.0 && answer.angular == 0.0;
  if (!stands && SafeMotion(parameters_, reaction_time_, now, now.history, margin)(answer)) return answer;
  return {{}, command.stop == StopReason::kNone ? StopReason::kObstacle : command.stop};
}

MotionCommand MotionController::driveWithCorners(const Twist2& wanted, double error, const Moment& now) const {
  const bool heads_there = std::abs(error) < kLeastTurn;
  if (now.history.goes_back && !heads_there) return makeRoom(error, now);
  const auto [speed, stop] = safeSpeedWithCorners(wanted, now);
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
    const double angular = wantedTurn(error, parameters_.max_angular);
    for (const double share : kNarrower) {
      const Twist2 arc{slowSpeed(parameters_), share * angular};
      const auto [speed, stop] = safeSpeedWithCorners(arc, now);
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
  SafeMotion isSafe(parameters_, reaction_time_, now, now.history, now.margin);
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
  SafeMotion isSafe(parameters_, reaction_time_, now, now.history,
                    kLeastMargin * parameters_.safety_margin);  // it was there already
  const auto twist = fastestShare(wanted, [&](const Twist2& share) {
    const Twist2 limited = withinWheelLimits(share);
    // Not beyond that place: it came there from elsewhere.
    const double length = std::abs(limited.linear) * (reaction_time_ + 0.5 * brakingTime(parameters_, limited));
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
  const double time = std::max({std::abs(along) / fastest, 2.0 * std::abs(turn) / parameters_.max_angular,
                                1.0 / headingGain(parameters_.heading_gain, reaction_time_)});
  return {std::abs(along) < kTurnsOnly ? 0.0 : along / time, turn / time};
}

double MotionController::turningSpeed(double angle, const Moment& now) const {
  const double most = std::min(parameters_.max_angular, yieldingTurn(now.persons));
  const double wanted = wantedTurn(angle, most);
  const auto twist = fastestShare({0.0, wanted}, SafeMotion(parameters_, reaction_time_, now, now.history, now.margin));
  return twist ? twist->angular : 0.0;
}

/// Its corners must stand before somebody can reach them.
double MotionController::yieldingTurn(const Persons& persons) const {
  const Footprint& footprint = persons.moving.footprint();
  const double sweep = footprint.circumscribedRadius() - footprint.inscribedRadius();
  const double gap = persons.moving.gap({}) - sweep - parameters_.person_margin;
  const double time = gap / parameters_.person_speed - reaction_before_persons_;
  return std::max(0.0, time * parameters_.linear_acceleration / (0.5 * parameters_.axle_length));
}

MotionController::SafeSpeed MotionController::safeSpeedWithCorners(const Twist2& wanted, const Moment& now) const {
  const double cautious = std::min(wanted.linear, cautiousSpeed(wanted, now.shield));
  StopReason stop = cautious < wanted.linear ? StopReason::kObstacle : StopReason::kNone;
  SafeMotion isSafe(parameters_, reaction_time_, now, now.history, now.margin);
  for (const double share : kShares) {
    const Twist2 twist{share * cautious, wanted.angular};
    if (twist.linear < kCreep) break;
    const double before_persons = yieldingSpeed(twist, now.persons);
    if (before_persons < twist.linear) {
      stop = StopReason::kPerson;
    } else if (isSafe(withinWheelLimits(twist))) {
      return {twist.linear, stop};
    } else {
      stop = StopReason::kObstacle;
    }
  }
  return {0.0, stop};
}

MotionCommand MotionController::evade(const MotionCommand& command, const MotionSituation& situation,
                                      const std::vector<MovingThing>& things, double free_behind,
                                      const MotionHistory& history) const {
  const auto& [plan, pose, current, shield, period] = situation;
  if (parameters_.evade_time <= 0.0 || things.empty() || plan.empty()) return command;
  if (command.stop == StopReason::kUnusableData || !(period >= kShortestPeriod)) return command;
  const Evasion evasion(parameters_, reaction_time_, shield, things, current);
  const Outlook wanted = evasion.withCommand(command);
  if (wanted.room >= parameters_.evade_margin) return command;
  const double distance = parameters_.max_linear * parameters_.evade_time;
  const Pose2& far = firstBeyond(plan.begin(), plan, pose, distance);
  const Point2 target = toLocalFrame(pose, {far.x, far.y});
  const auto worth = [&](const Outlook& outlook) {
    return kRoomWeight * std::min(1.0, outlook.room / parameters_.evade_margin) +
           kTouchWeight * outlook.touch / parameters_.evade_time - distanceBetween(outlook.end, target) / distance;
  };
  std::optional<SafeMotion> isSafe;
  if (!shield.footprint().isCircle())
    isSafe.emplace(parameters_, reaction_time_, situation, history, parameters_.safety_margin);
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

void MotionHistory::note(const Twist2& command, double time, double period) {
  const auto most = static_cast<std::size_t>(std::ceil(time / period)) + 1;
  commanded.push_back(command);
  if (commanded.size() > most) commanded.erase(commanded.begin(), commanded.end() - static_cast<std::ptrdiff_t>(most));
}

}  // namespace lstm_planner
