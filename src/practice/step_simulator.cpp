#include "lstm_planner/practice/step_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "lstm_planner/common/arc.hpp"
#include "lstm_planner/drive/decision/step_clock.hpp"
#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "lstm_planner/practice/teacher.hpp"

namespace lstm_planner {
namespace {

/// s; the robot turns while it drives, in pieces of this length.
constexpr double kSimulatedPiece = 0.1;

/// m/s; a faster robot slows down from farther away.
constexpr double kUsualSpeed = 0.5;

}  // namespace

PracticeConditions usualConditions() {
  PracticeConditions conditions;
  HokuyoParameters& scanner = conditions.scanner;
  scanner.beams = 136;
  scanner.angle_increment = -2.0 * scanner.angle_min / (scanner.beams - 1);
  scanner.sight = 10.0;
  return conditions;
}

AgentParameters practiceAgent(const PolicyDescription& policy) {
  AgentParameters agent;
  agent.step.length = policy.step_length;
  agent.shield.footprint_radius = policy.footprint_radius;
  agent.escape.enabled = false;
  agent.memory.enabled = false;
  // Judged is what the network reaches by the answers that it prefers.
  agent.draw_after = 0;
  return fittedToFootprint(agent);
}

NavigationAgent drawRobot(AgentParameters agent, PolicyDescription policy, const LayerStack& layers, Random& random) {
  policy.footprint_radius = kPracticeRadius;
  policy.step_length *= uniform(random, 0.75, 1.25);
  agent.step.length = policy.step_length;
  agent.shield.footprint_radius = kPracticeRadius;
  return NavigationAgent(DrivePolicy(policy, layers), fittedToFootprint(agent));
}

PracticeConditions drawConditions(Random& random) {
  PracticeConditions conditions = usualConditions();
  conditions.scanner.noise = uniform(random, 0.002, 0.03);
  conditions.scanner.dropout = uniform(random) < 0.5 ? 0.001 : uniform(random, 0.0, 0.05);
  SensorMount& mount = conditions.scanner.mount;
  mount.pose = {uniform(random, -0.1, 0.1), uniform(random, -0.03, 0.03), uniform(random, -0.04, 0.04)};
  conditions.period = uniform(random, 0.4, 0.7);
  conditions.speed = uniform(random, 0.2, 0.5);
  conditions.latency = uniform(random, 0.0, 0.3);
  conditions.travel_error = uniform(random, -0.03, 0.03);
  conditions.turn_error = uniform(random, -0.02, 0.02);
  conditions.slip = uniform(random, 0.0, 0.1);
  return conditions;
}

StepSimulator::StepSimulator(const World& world, const DriveTask& task, const PracticeConditions& conditions,
                             std::uint64_t seed)
    : world_(world),
      task_(task),
      conditions_(conditions),
      random_(seed),
      scanner_(conditions.scanner, ~seed),
      pose_(task.start) {}

LoopEnd StepSimulator::run(int max_steps, NavigationAgent* agent) {
  int steps = 0;
  const auto goes_on = [&steps, max_steps] { return steps++ < max_steps; };
  const auto note = [](const Decision&) {};
  return runClosedLoop(toLocalFrame(task_.start, task_.goal), this, agent, goes_on, note);
}

bool StepSimulator::sense(double range_cap, Situation* situation) {
  scanner_.scan(world_, pose_, time_, &scan_);
  perceive(scan_, conditions_.scanner.mount, Hokuyo::rules(), range_cap, situation);
  situation->time = time_;
  situation->pose = odometry_;
  return true;
}

bool StepSimulator::hasArrived(const Situation& situation, const Point2& end) const {
  return distanceBetween(situation.pose, end) <= MotionParameters().position_tolerance;
}

void StepSimulator::carryOut(const Situation&, const Decision& decision, const NavigationAgent& agent) {
  const StepParameters& step = agent.parameters().step;
  const Pose2 start = odometry_;
  for (double elapsed = 0.0; elapsed < conditions_.period - 1e-9; elapsed += kSimulatedPiece) {
    const double period = std::min(kSimulatedPiece, conditions_.period - elapsed);
    if (elapsed + 1e-9 >= conditions_.latency) twist_ = steer(decision, agent, period);
    move(twist_, period);
    time_ += period;
    if (isStepDriven(step, start, odometry_, decision.waypoint)) break;
  }
}

/// As MotionController does for the plan of a decision.
Twist2 StepSimulator::steer(const Decision& decision, const NavigationAgent& agent, double period) const {
  const MotionParameters motion;
  const double error = normalizeAngle(directionTo(odometry_, decision.waypoint) - odometry_.yaw);
  Twist2 twist;
  twist.angular = std::clamp(motion.heading_gain * error, -motion.max_angular, motion.max_angular);
  if (std::abs(error) < motion.turn_in_place) {
    const double slow_gap = motion.slow_gap * std::max(1.0, conditions_.speed / kUsualSpeed);
    const double nearness = std::clamp(agent.shield().gap({}) / slow_gap, 0.0, 1.0);
    const double cautious = motion.slow_speed + nearness * (conditions_.speed - motion.slow_speed);
    const double reachable = twist_.linear + motion.linear_acceleration * period;
    twist.linear = std::min({conditions_.speed * std::cos(error), cautious, reachable});
  }
  return twist;
}

void StepSimulator::move(const Twist2& twist, double seconds) {
  const double turn = twist.angular * seconds;
  double length = twist.linear * seconds;
  // One after the other: compilers differ in the order of arguments.
  const double true_turn = turn * (1.0 + conditions_.slip * normal(random_));
  const double true_length = length * (1.0 + conditions_.slip * normal(random_));
  Pose2 next = alongMeanHeading(pose_, true_length, true_turn);
  const bool touches = world_.touches({next.x, next.y}, kPracticeRadius);
  contacts_.note(touches);
  if (touches) {
    next = {pose_.x, pose_.y, next.yaw};
    length = 0.0;
  }
  path_length_ += distanceBetween(pose_, next);
  pose_ = next;
  odometry_ =
      alongMeanHeading(odometry_, length * (1.0 + conditions_.travel_error), turn + conditions_.turn_error * length);
}

}  // namespace lstm_planner
