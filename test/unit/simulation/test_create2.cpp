#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "lstm_planner/simulation/create2.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_create2 {
namespace {

constexpr double kTickLength = M_PI * 0.072 / 508.8;

/// No ramps, so that the closed forms hold from the first step.
Create2Parameters instantAcceleration() {
  Create2Parameters parameters;
  parameters.max_wheel_acceleration = 1e9;
  return parameters;
}

void drive(Create2* robot, const Twist2& twist, int steps, double seconds = 0.01) {
  robot->command(twist);
  for (int i = 0; i < steps; ++i) robot->step(seconds);
}

TEST(Create2, ReturnsToTheStartOfACircle) {
  const Pose2 start{1.0, -2.0, 0.5};
  Create2 robot(instantAcceleration(), start, 1);
  const double turn_rate = 0.4;
  drive(&robot, {0.2, turn_rate}, 1000, 2.0 * M_PI / turn_rate / 1000.0);
  EXPECT_NEAR(robot.truePose().x, start.x, 1e-7);
  EXPECT_NEAR(robot.truePose().y, start.y, 1e-7);
  EXPECT_NEAR(robot.truePose().yaw, start.yaw, 1e-7);
}

TEST(Create2, FollowsTheArcWhateverTheLengthOfAStep) {
  // A quarter of a circle of 0.5 m in one step ends where a thousand steps end.
  for (const int steps : {1, 1000}) {
    Create2 robot(instantAcceleration(), {}, 1);
    drive(&robot, {0.25, 0.5}, steps, M_PI / steps);
    EXPECT_NEAR(robot.truePose().x, 0.5, 1e-7);
    EXPECT_NEAR(robot.truePose().y, 0.5, 1e-7);
    EXPECT_NEAR(robot.truePose().yaw, M_PI_2, 1e-7);
  }
}

TEST(Create2, CountsWholeTicksOnAStraightLine) {
  Create2 robot(instantAcceleration(), {5.0, 5.0, 2.0}, 1);
  drive(&robot, {0.3, 0.0}, 100);
  const double ticks = std::floor(0.3 / kTickLength);  // 674
  EXPECT_NEAR(robot.odometry().x, ticks * kTickLength, 1e-9) << "odometry starts at 0 wherever the robot stands";
  EXPECT_EQ(robot.odometry().y, 0.0);
  EXPECT_NEAR(robot.wheelAngle(true), ticks * 2.0 * M_PI / 508.8, 1e-9);
  EXPECT_EQ(robot.wheelAngle(true), robot.wheelAngle(false));
  EXPECT_NEAR(distanceBetween(robot.truePose(), Point2{5.0, 5.0}), 0.3, 1e-7);
}

TEST(Create2, ReportsNoMotionBelowATick) {
  Create2 robot(instantAcceleration(), {}, 1);
  drive(&robot, {0.9 * kTickLength, 0.0}, 1, 1.0);
  EXPECT_EQ(robot.odometry().x, 0.0);
  EXPECT_EQ(robot.measuredTwist().linear, 0.0);
  drive(&robot, {0.9 * kTickLength, 0.0}, 1, 1.0);
  EXPECT_DOUBLE_EQ(robot.measuredTwist().linear, kTickLength);
}

TEST(Create2, KeepsOdometryWithinATickOfTheTruthWithoutSlip) {
  Create2 robot(Create2Parameters{}, {}, 1);
  for (int i = 0; i < 60; ++i) drive(&robot, {0.2 + 0.1 * std::sin(i), 0.8 * std::cos(0.3 * i)}, 50);
  // A tick of one wheel is 0.11 degrees of heading; 9 m of path at that error are 2 cm.
  EXPECT_NEAR(normalizeAngle(robot.odometry().yaw - robot.truePose().yaw), 0.0, 2.0 * kTickLength / 0.235);
  EXPECT_LT(distanceBetween(robot.odometry(), robot.truePose()), 0.02);
}

TEST(Create2, ClipsEachWheelOnItsOwn) {
  // 0.4 m/s and 2 rad/s ask for wheels at 0.165 and 0.635 m/s; the right one is clipped to 0.5.
  Create2 robot(instantAcceleration(), {}, 1);
  drive(&robot, {0.4, 2.0}, 1, 10.0);
  EXPECT_NEAR(robot.measuredTwist().linear, (0.165 + 0.5) / 2.0, kTickLength);
  EXPECT_NEAR(robot.measuredTwist().angular, (0.5 - 0.165) / 0.235, kTickLength);
}

TEST(Create2, AcceleratesWithinItsLimit) {
  Create2Parameters parameters;
  parameters.max_wheel_acceleration = 0.5;
  Create2 robot(parameters, {}, 1);
  drive(&robot, {0.25, 0.0}, 100);
  // Half a second of ramp at 0.5 m/s^2, then half a second at 0.25 m/s.
  EXPECT_NEAR(robot.truePose().x, 0.5 * 0.5 * 0.25 + 0.5 * 0.25, 1e-12);
}

TEST(Create2, StopsOnACommandThatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Twist2& twist : {Twist2{nan, 0.0}, Twist2{0.0, HUGE_VAL}}) {
    Create2 robot(instantAcceleration(), {}, 1);
    drive(&robot, {0.3, 0.0}, 1);
    const double before = robot.truePose().x;
    drive(&robot, twist, 10);
    EXPECT_NEAR(robot.truePose().x, before, 1e-9);
    EXPECT_TRUE(isFinite(robot.truePose()));
  }
}

TEST(Create2, KeepsCountingWhileItIsHeld) {
  Create2 robot(instantAcceleration(), {}, 1);
  for (int i = 0; i < 100; ++i) {
    drive(&robot, {0.2, 0.0}, 1);
    robot.holdPosition({});
  }
  EXPECT_EQ(robot.truePose().x, 0.0);
  EXPECT_NEAR(robot.odometry().x, 0.2, kTickLength);
}

TEST(Create2, DriftsByTheErrorOfItsWheels) {
  Create2Parameters parameters = instantAcceleration();
  parameters.drift = 0.01;
  Create2 robot(parameters, {}, 1);
  drive(&robot, {0.2, 0.0}, 500);
  EXPECT_NEAR(robot.truePose().yaw, -1.0 * 0.02 / 0.235, 1e-7) << "the left wheel goes 2 % farther than the right one";
  EXPECT_EQ(robot.odometry().yaw, 0.0) << "the encoders do not see it";
}

/// Root mean square over many robots of how far each is from where its odometry puts it, after a straight path, m.
double typicalError(double share, double path) {
  constexpr int kRobots = 400;
  double squares = 0.0;
  for (std::uint64_t seed = 1; seed <= kRobots; ++seed) {
    Create2Parameters parameters = instantAcceleration();
    parameters.odometry_error = share;
    Create2 robot(parameters, {}, seed);
    drive(&robot, {0.3, 0.0}, static_cast<int>(std::lround(path / 0.3 / 0.1)), 0.1);
    const double error = distanceBetween(robot.truePose(), robot.odometry());
    squares += error * error / kRobots;
  }
  return std::sqrt(squares);
}

TEST(Create2, ErrsByAboutTwoPercentOfTheDistance) {
  for (const double path : {9.0, 18.0, 90.0}) {
    // Lengths are wrong by a uniform share, 0.02 / sqrt(3). A heading that wanders from 0 by 0.03 rad with a memory of
    // L = 20 m leads aside by the integral of an Ornstein-Uhlenbeck process, whose variance is
    // 0.03^2 (2 L path - L^2 (3 - 4 exp(-path / L) + exp(-2 path / L))).
    const double lengthwise = 0.02 * path / std::sqrt(3.0);
    const double past = std::exp(-path / 20.0);
    const double aside = 0.03 * std::sqrt(40.0 * path - 400.0 * (3.0 - 4.0 * past + past * past));
    const double expected = std::hypot(lengthwise, aside);
    // The root mean square of 400 draws is known to 1 / sqrt(800), that is 3.5 %; three times that.
    EXPECT_NEAR(typicalError(0.02, path), expected, 0.11 * expected);
    EXPECT_GT(expected, 0.017 * path);
    EXPECT_LT(expected, 0.022 * path);
  }
}

TEST(Create2, ErrsInItsTurnsByOneShareForEachRobot) {
  Create2Parameters parameters = instantAcceleration();
  parameters.odometry_error = 0.02;
  double previous = 0.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Create2 robot(parameters, {}, seed);
    drive(&robot, {0.0, 1.0}, 300);  // 3 rad on the spot: no path, so no wandering
    const double share = robot.truePose().yaw / 3.0 - 1.0;
    EXPECT_LE(std::abs(share), 0.02);
    EXPECT_NE(share, previous);
    EXPECT_NEAR(robot.odometry().yaw, 3.0, 2.0 * kTickLength / 0.235);
    drive(&robot, {0.0, -1.0}, 300);
    EXPECT_NEAR(robot.truePose().yaw, 0.0, 1e-7) << "the error of a turn is undone by turning back";
    previous = share;
  }
}

TEST(Create2, SlipsAlikeForTheSameSeed) {
  Create2Parameters parameters;
  parameters.slip = 0.05;
  Create2 a(parameters, {}, 42);
  Create2 b(parameters, {}, 42);
  Create2 c(parameters, {}, 43);
  for (Create2* robot : {&a, &b, &c}) drive(robot, {0.3, 0.2}, 200);
  EXPECT_EQ(a.truePose().x, b.truePose().x);
  EXPECT_EQ(a.truePose().yaw, b.truePose().yaw);
  EXPECT_NE(a.truePose().x, c.truePose().x);
  EXPECT_EQ(a.odometry().x, c.odometry().x) << "slip does not turn the encoders";
}

TEST(Create2, RefusesImpossibleParameters) {
  Create2Parameters parameters;
  parameters.axle_length = 0.0;
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { Create2(parameters, {}, 1); }),
            "parameter axle_length is 0, expected a number in [0.01, 5]");
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([] {
              Create2({}, {HUGE_VAL, 0.0, 0.0}, 1);
            }),
            "the robot's first pose is not finite");
}

}  // namespace
}  // namespace lstm_planner::test_create2
