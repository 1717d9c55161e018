#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "lstm_planner/common/random.hpp"
#include "support/motion_trial.hpp"

namespace lstm_planner::test_motion_trials {
namespace {

using test::MotionTrial;

constexpr double kExact = 2e-3;  // m; sweeps are exact to a millimetre, and wheels are foreseen in pieces of 25 ms
constexpr double kRounding = 1e-9;
constexpr int kCommands = 60;     // 3 s
constexpr double kAtOnce = 50.0;  // m/s^2
constexpr double kAsItBrakes = 0.0;

/// Any convex footprint around the origin, off centre too.
Footprint anyPolygon(Random& random) {
  for (;;) {
    const double size = uniform(random, 0.1, 0.6);
    const Point2 off{uniform(random, -0.5, 0.5) * size, uniform(random, -0.2, 0.2) * size};
    std::vector<Point2> points(3 + uniformIndex(random, 6));
    for (Point2& point : points) {
      point = {off.x + uniform(random, -size, size), off.y + uniform(random, -size, size)};
    }
    try {
      const Footprint footprint(points);
      if (footprint.inscribedRadius() > 0.02) return footprint;
    } catch (const std::invalid_argument&) {  // the origin is outside
    }
  }
}

/// A robot of any kind amid returns from 1 mm to 1 m away.
MotionTrial anyTrial(Random& random, const Footprint& footprint) {
  MotionTrial trial;
  trial.footprint = footprint;
  MotionParameters& motion = trial.motion;
  motion.safety_margin = uniform(random, 0.01, 0.08);
  motion.max_linear = uniform(random, 0.1, 2.0);
  motion.max_angular = uniform(random, 0.5, 4.0);
  motion.axle_length = uniform(random, 0.1, 0.6);
  motion.max_wheel_speed = motion.max_linear + uniform(random, 0.05, 0.5);
  motion.linear_acceleration = uniform(random, 0.3, 3.0);
  motion.slow_speed = uniform(random, 0.02, 0.5);
  motion.reaction_time = uniform(random, 0.1, 0.4);
  trial.latency = uniform(random, 0.0, motion.reaction_time - trial.period);
  trial.has_stood = uniform(random) < 0.25;
  const std::size_t count = 1 + uniformIndex(random, 12);
  while (trial.returns.size() < count) {
    const Point2 point{uniform(random, -1.3, 1.3), uniform(random, -1.3, 1.3)};
    const double gap = footprint.distanceTo(point);
    if (gap > 1e-3 && gap < 1.0) trial.returns.push_back(point);
  }
  trial.goal = pointAlong(Point2{}, uniform(random, -M_PI, M_PI), 3.0);
  return trial;
}

/// For how many the robot moves; fails where it comes nearer to a return than it may.
template <typename AnyFootprint>
int movesIn(int trials, double wheel_acceleration, const AnyFootprint& anyFootprint, std::uint64_t seed = 3,
            double turn = 0.0) {
  Random random(seed);
  int moved = 0;
  for (int i = 0; i < trials; ++i) {
    MotionTrial trial = anyTrial(random, anyFootprint(random));
    trial.motion.wheel_acceleration = wheel_acceleration;
    trial.turn = turn;
    EXPECT_LT(trial.shortfall(kCommands), kExact) << i;
    EXPECT_LT(trial.beyond_limits, kRounding) << i;
    moved += trial.has_moved;
  }
  return moved;
}

Footprint anyCircle(Random& random) { return Footprint(uniform(random, 0.05, 0.5)); }

class MotionTrials : public ::testing::TestWithParam<double> {};

TEST_P(MotionTrials, APolygonComesNoNearerThanItsMargin) {
  EXPECT_GT(movesIn(400, GetParam(), anyPolygon), 380) << "it does not only stand";
}

TEST_P(MotionTrials, ACircleComesNoNearerThanItsMargin) {
  EXPECT_GT(movesIn(2900, GetParam(), anyCircle), 2850) << "it does not only stand";
}

TEST_P(MotionTrials, ACircleThatBrakesSlowlyDoesNotDriveOnWhereNothingIsFree) {
  EXPECT_GT(movesIn(100, GetParam(), anyCircle, 117), 98) << "trial 80 with wheels as it brakes";
}

TEST_P(MotionTrials, ACircleWhosePlanLeadsElsewhereBrakesWhereNothingIsFree) {
  EXPECT_GT(movesIn(420, GetParam(), anyCircle, 3, 2.5), 410) << "trial 418 with wheels as it brakes";
}

INSTANTIATE_TEST_SUITE_P(Wheels, MotionTrials, ::testing::Values(kAtOnce, kAsItBrakes),
                         [](const auto& info) { return info.param == kAtOnce ? "AtOnce" : "AsItBrakes"; });

}  // namespace
}  // namespace lstm_planner::test_motion_trials
