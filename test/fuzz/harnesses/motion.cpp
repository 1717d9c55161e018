#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "fuzz/fuzz_input.hpp"
#include "fuzz/harness.hpp"
#include "lstm_planner/common/footprint.hpp"
#include "support/motion_trial.hpp"

namespace lstm_planner::fuzz::motion_harness {
namespace {

constexpr int kCommands = 40;
constexpr double kExact = 2e-3;  // m, as in test_motion_trials.cpp
constexpr double kRounding = 1e-9;
constexpr double kLeastInside = 0.02;

Point2 pointWithin(double reach, FuzzInput* input) {
  const double x = input->numberIn(-reach, reach);
  return {x, input->numberIn(-reach, reach)};
}

std::optional<Footprint> anyFootprint(FuzzInput* input) {
  if (input->flag()) return Footprint(input->numberIn(0.05, 0.5));
  std::vector<Point2> points(static_cast<std::size_t>(input->integer(3, 8)));
  for (Point2& point : points) point = pointWithin(0.6, input);
  try {
    const Footprint footprint(points);
    if (footprint.inscribedRadius() >= kLeastInside) return footprint;
  } catch (const std::invalid_argument&) {  // the origin is outside
  }
  return std::nullopt;
}

/// A robot of any kind amid returns that stand: no command comes nearer to them than the margin, or than it is.
void motion(const std::uint8_t* data, std::size_t size) {
  FuzzInput input(data, size);
  const auto footprint = anyFootprint(&input);
  if (!footprint) return;
  test::MotionTrial trial;
  trial.footprint = *footprint;
  MotionParameters& motion = trial.motion;
  motion.safety_margin = input.numberIn(0.01, 0.08);
  motion.max_linear = input.numberIn(0.1, 2.0);
  motion.max_angular = input.numberIn(0.5, 4.0);
  motion.axle_length = input.numberIn(0.1, 0.6);
  motion.max_wheel_speed = motion.max_linear + input.numberIn(0.05, 0.5);
  motion.linear_acceleration = input.numberIn(0.3, 3.0);
  motion.slow_speed = input.numberIn(0.02, 0.5);
  motion.reaction_time = input.numberIn(0.1, 0.4);
  motion.wheel_acceleration = input.flag() ? 50.0 : 0.0;
  trial.latency = input.numberIn(0.0, motion.reaction_time - trial.period);
  trial.has_stood = input.flag();
  trial.goal = pointAlong(Point2{}, input.numberIn(-M_PI, M_PI), 3.0);
  while (!input.empty() && trial.returns.size() < 12) {
    const Point2 point = pointWithin(1.3, &input);
    if (footprint->distanceTo(point) > 1e-3) trial.returns.push_back(point);
  }
  require(trial.shortfall(kCommands) < kExact, "no return comes nearer than the margin, or than it is");
  require(trial.beyond_limits < kRounding, "no command is beyond the limits");
}

const Registration registration("motion", &motion);

}  // namespace
}  // namespace lstm_planner::fuzz::motion_harness
