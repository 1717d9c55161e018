#include "lstm_planner/agent/motion_controller.hpp"

#include <algorithm>
#include <cmath>

#include "lstm_planner/parameter_check.hpp"

namespace lstm_planner {

namespace {

constexpr double kBehind = 2.7;  // rad of heading error

double clamp(double value, double limit) { return std::max(-limit, std::min(limit, value)); }

}  // namespace

void validate(const MotionParameters& parameters) {
  checkPositive("max_linear", parameters.max_linear);
  checkPositive("max_angular", parameters.max_angular);
  checkPositive("linear_acceleration", parameters.linear_acceleration);
  checkPositive("lookahead", parameters.lookahead);
  checkPositive("nearest_target", parameters.nearest_target);
  checkPositive("turn_in_place", parameters.turn_in_place);
  checkPositive("heading_gain", parameters.heading_gain);
  checkPositive("reaction_time", parameters.reaction_time);
  checkPositive("safety_margin", parameters.safety_margin);
  checkPositive("slow_gap", parameters.slow_gap);
  checkPositive("slow_speed", parameters.slow_speed);
  checkPositive("position_tolerance", parameters.position_tolerance);
  checkPositive("heading_tolerance", parameters.heading_tolerance);
}

MotionController::MotionController(const MotionParameters& parameters)
    : parameters_((validate(parameters), parameters)) {}

Twist2 MotionController::compute(const std::vector<Pose2>& plan, const Pose2& pose, const Twist2& current,
                                 const Shield& shield, double period) const {
  if (plan.empty() || !isFinite(pose)) {
    return {};
  }
  const Pose2& goal = plan.back();
  const double to_goal = distanceBetween(pose, goal);
  if (to_goal <= parameters_.position_tolerance) {
    const double error = normalizeAngle(goal.yaw - pose.yaw);
    const bool aligned = std::abs(error) <= parameters_.heading_tolerance;
    return {0.0, aligned ? 0.0 : clamp(parameters_.heading_gain * error, parameters_.max_angular)};
  }

  const Pose2 ahead = target(plan, pose, shield);
  double error = normalizeAngle(directionTo(pose, ahead) - pose.yaw);
  if (!std::isfinite(error)) {
    return {};  // the plan is not finite
  }
  // What lies behind may be a little to the left now and a little to the right next time: go on turning the way we
  // turn.
  if (std::abs(error) > kBehind && error * current.angular < 0.0) {
    error -= std::copysign(2.0 * M_PI, error);
  }
  Twist2 twist;
  twist.angular = clamp(parameters_.heading_gain * error, parameters_.max_angular);
  if (std::abs(error) < parameters_.turn_in_place) {
    const double brakes = std::sqrt(2.0 * parameters_.linear_acceleration * to_goal);
    const double nearness = std::min(1.0, std::max(0.0, shield.gap({}) / parameters_.slow_gap));
    const double cautious = parameters_.slow_speed + nearness * (parameters_.max_linear - parameters_.slow_speed);
    const double wanted = std::min({parameters_.max_linear * std::cos(error), brakes, cautious});
    const double reachable = std::max(0.0, current.linear) + parameters_.linear_acceleration * period;
    twist.linear = safeSpeed(std::min(wanted, reachable), twist.angular, std::max(0.0, current.linear), shield);
  }
  return twist;
}

bool MotionController::goalReached(const Pose2& pose, const Pose2& goal) const {
  return distanceBetween(pose, goal) <= parameters_.position_tolerance &&
         (parameters_.heading_tolerance >= M_PI ||
          std::abs(normalizeAngle(goal.yaw - pose.yaw)) <= parameters_.heading_tolerance);
}

Pose2 MotionController::target(const std::vector<Pose2>& plan, const Pose2& pose, const Shield& shield) const {
  std::size_t nearest = 0;
  double nearest_distance = distanceBetween(plan[0], pose);
  // Only as far as one lookahead: the plan may come by here again later.
  double length = 0.0;
  for (std::size_t i = 1; i < plan.size() && length < 2.0 * parameters_.lookahead; ++i) {
    length += distanceBetween(plan[i - 1], plan[i]);
    const double distance = distanceBetween(plan[i], pose);
    if (distance < nearest_distance) {
      nearest = i;
      nearest_distance = distance;
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
    if (!needed && shield.freeDistance({}, direction, distance, parameters_.safety_margin) < distance) {
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

double MotionController::safeSpeed(double linear, double angular, double current, const Shield& shield) const {
  constexpr int kTries = 6;
  constexpr int kSamples = 6;
  for (int trial = 0; trial < kTries; ++trial) {
    const double speed = linear * (kTries - trial) / kTries;
    // Until the command acts the robot goes on as it does now.
    const double length =
        std::max(speed, current) * parameters_.reaction_time + speed * speed / (2.0 * parameters_.linear_acceleration);
    const double curvature = speed > 1e-6 ? angular / speed : 0.0;
    Pose2 at;
    bool safe = true;
    for (int i = 0; i < kSamples && safe; ++i) {
      const double part = length / kSamples;
      const double direction = at.yaw + 0.5 * curvature * part;
      safe = shield.freeDistance({at.x, at.y}, direction, part, parameters_.safety_margin) >= part;
      const Point2 next = pointAlong(at, direction, part);
      at = {next.x, next.y, at.yaw + curvature * part};
    }
    if (safe) {
      return speed;
    }
  }
  return 0.0;
}

}  // namespace lstm_planner
