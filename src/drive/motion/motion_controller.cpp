#include "lstm_planner/drive/motion/motion_controller.hpp"

#include <algorithm>
#include <cmath>

#include "drive/motion/motion_parts.hpp"
#include "lstm_planner/common/arc.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"

namespace lstm_planner {

namespace {

constexpr double kBehind = 2.7;  // rad of heading error

/// m/s; up to here the robot speeds up from what it was told last, not only from what it measures: the motors of many
/// bases stand still at less.
constexpr double kStart = 0.1;

/// m/s, from which the robot speeds up.
double reached(const Twist2& measured, const MotionHistory& history) {
  const double told = history.commanded.empty() ? 0.0 : history.commanded.back().linear;
  return std::max({0.0, measured.linear, std::min(told, kStart)});
}

}  // namespace

void validate(const MotionParameters& parameters) {
  visitMotionParameters(parameters, RangeCheck());
  const double wheels = parameters.wheel_acceleration;
  checkParameter(wheels == 0.0 || wheels >= 0.01, "wheel_acceleration", wheels, "0 or at least 0.01");
  validate(parameters.moving);
}

MotionController::MotionController(const MotionParameters& parameters)
    : parameters_((validate(parameters), parameters)), reaction_time_(parameters.reaction_time) {}

MotionCommand MotionController::compute(const MotionSituation& situation, const std::vector<Point2>& moving,
                                        const std::vector<Point2>& resting, const MotionHistory& history) const {
  const auto& [plan, pose, current, shield, period] = situation;
  if (plan.empty()) return {{}, StopReason::kNoPlan};
  if (!isFinite(pose)) return {{}, StopReason::kUnusableData};
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
    const double error = normalizeAngle(goal.yaw - pose.yaw);
    const bool aligned = std::abs(error) <= parameters_.heading_tolerance;
    if (aligned) return {{}, StopReason::kArrived};
    if (has_corners) return turnWithCorners(error, now);
    return {{0.0, clampMagnitude(parameters_.heading_gain * error, parameters_.max_angular)}, StopReason::kNone};
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
  Twist2 twist{0.0, clampMagnitude(parameters_.heading_gain * error, parameters_.max_angular)};
  StopReason stop = StopReason::kNone;
  if (std::abs(error) < parameters_.turn_in_place) {
    const double brakes = std::sqrt(2.0 * parameters_.linear_acceleration * to_goal);
    const double reachable = reached(current, now.history) + parameters_.linear_acceleration * period;
    twist.linear = std::min({parameters_.max_linear * std::cos(error), brakes, reachable});
    twist = withinWheelLimits(twist);
    if (has_corners) return driveWithCorners(twist, error, now);
    const SafeSpeed safe = safeSpeed(twist, situation, persons);
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
         (parameters_.heading_tolerance >= M_PI ||
          std::abs(normalizeAngle(goal.yaw - pose.yaw)) <= parameters_.heading_tolerance);
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

Twist2 MotionController::withinWheelLimits(const Twist2& twist) const {
  const double fastest = std::abs(twist.linear) + 0.5 * parameters_.axle_length * std::abs(twist.angular);
  const double share = std::min(1.0, parameters_.max_wheel_speed / fastest);
  return fastest > 0.0 ? Twist2{share * twist.linear, share * twist.angular} : twist;
}

MotionController::SafeSpeed MotionController::safeSpeed(const Twist2& wanted, const MotionSituation& situation,
                                                        const Persons& persons) const {
  constexpr int kTries = 8;
  double speed = std::min(wanted.linear, cautiousSpeed(wanted, situation.shield));
  StopReason stop = speed < wanted.linear ? StopReason::kObstacle : StopReason::kNone;
  for (int i = 0; i < kTries && speed >= kCreep; ++i) {
    const Twist2 twist{speed, wanted.angular};
    const double before_obstacles = allowedSpeed(twist, situation);
    const double before_persons = yieldingSpeed(twist, persons);
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
  const double time = reaction_time_ + parameters_.max_linear / parameters_.linear_acceleration;
  return footprint_radius + stoppingDistance(parameters_.max_linear) + parameters_.person_margin +
         parameters_.person_speed * time + footprint_radius;
}

double MotionController::yieldingSpeed(const Twist2& twist, const Shield& persons) const {
  const double gap = persons.arcGap({}, twist.angular / twist.linear, stoppingDistance(twist.linear));
  const double time = (gap - parameters_.person_margin) / parameters_.person_speed;
  return std::max(0.0, (time - reaction_time_) * parameters_.linear_acceleration);
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
  const auto tryCommand = [&](const Twist2& command) {
    if (farthest == WheelMotion::kFree) return;
    const double free = motion.free(command);
    // Where nothing is free it brakes: whoever drives on for a little more air has less of it next time. Of commands
    // that are as good the last one, which turns least.
    if (free < farthest || (command.linear != 0.0 && free != WheelMotion::kFree)) return;
    farthest = free;
    best = command;
  };
  const auto turnLess = [&](double linear) {
    for (const double share : {0.5, 0.25, 0.0}) tryCommand({linear, before + share * (twist.angular - before)});
  };
  tryCommand(twist);
  if (twist.linear != 0.0 && !now.persons.near) turnLess(twist.linear);  // on another arc it would have to yield anew
  turnLess(0.0);
  // Wheels that all take time keep their common speed the longer the more the turn changes.
  tryCommand({0.0, clampMagnitude(now.current.angular, parameters_.max_angular)});
  tryCommand({});
  return best;
}

void MotionHistory::note(const Twist2& command, double time, double period) {
  const auto most = static_cast<std::size_t>(std::ceil(time / period)) + 1;
  commanded.push_back(command);
  if (commanded.size() > most) commanded.erase(commanded.begin(), commanded.end() - static_cast<std::ptrdiff_t>(most));
}

}  // namespace lstm_planner
