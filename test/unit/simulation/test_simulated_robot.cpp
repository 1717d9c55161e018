#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "lstm_planner/simulation/crowd.hpp"
#include "lstm_planner/simulation/simulated_robot.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_simulated_robot {
namespace {

TEST(SimulatedRobot, CountsAContactOnceAndStops) {
  const CircleWorld world({{{1.0, 0.0}, 0.2}});
  SimulatedRobot robot(world, {}, {}, 1);
  robot.command({0.3, 0.0});
  robot.advance(5.0);
  EXPECT_EQ(robot.contacts(), 1);
  // It touches at 1 - 0.2 - 0.17425; a period of 0.02 s at 0.3 m/s is 6 mm.
  EXPECT_NEAR(robot.truePose().x, 0.62575, 0.0061);
  EXPECT_FALSE(world.touches({robot.truePose().x, robot.truePose().y}, 0.17425));
  EXPECT_NEAR(robot.pathLength(), robot.truePose().x, 1e-9);
  EXPECT_GT(robot.odometry().x, 1.0);  // the wheels spin on
}

TEST(SimulatedRobot, CountsASecondRunAgainstTheSameThing) {
  const CircleWorld world({{{1.0, 0.0}, 0.2}});
  SimulatedRobot robot(world, {}, {}, 1);
  robot.command({0.3, 0.0});
  robot.advance(4.0);
  robot.command({-0.3, 0.0});
  robot.advance(1.0);
  robot.command({0.3, 0.0});
  robot.advance(4.0);
  EXPECT_EQ(robot.contacts(), 2);
}

TEST(SimulatedRobot, ACornerThatTurnsIntoSomethingTouchesIt) {
  const CircleWorld world({{{0.0, 0.35}, 0.05}});  // 0.3 m to the left of its middle
  SimulatedRobot::Parameters parameters;
  parameters.base.footprint = "[[0.3, 0.2], [0.3, -0.2], [-0.3, -0.2], [-0.3, 0.2]]";
  SimulatedRobot robot(world, parameters, {}, 1);
  robot.command({0.0, 1.0});
  robot.advance(3.0);
  EXPECT_EQ(robot.contacts(), 1);
  EXPECT_LT(robot.truePose().yaw, M_PI_2) << "it is held as it stands";
  EXPECT_GT(robot.odometry().yaw, M_PI_2) << "the wheels spin on";

  SimulatedRobot round(world, {}, {}, 1);
  round.command({0.0, 1.0});
  round.advance(3.0);
  EXPECT_EQ(round.contacts(), 0);
}

TEST(SimulatedRobot, SensesInTheOdometryFrame) {
  const CircleWorld world({{{2.0, 5.0}, 0.5}});
  SimulatedRobot::Parameters parameters;
  parameters.scanner.noise = 0.0;
  parameters.scanner.dropout = 0.0;
  SimulatedRobot robot(world, parameters, {2.0, 2.0, M_PI_2}, 1);
  Situation situation;
  robot.sense(6.0, &situation);
  EXPECT_EQ(situation.time, 0.0);
  EXPECT_EQ(situation.pose.x, 0.0);  // odometry starts at the start
  EXPECT_EQ(situation.pose.yaw, 0.0);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Point2& point : situation.obstacles) nearest = std::min(nearest, point.x);
  EXPECT_NEAR(nearest, 2.5, 1e-4);
}

TEST(SimulatedRobot, ASecondScannerScansAtItsOwnRate) {
  const CircleWorld world({{{-2.0, 0.0}, 0.5}});
  SimulatedRobot::Parameters parameters;
  parameters.second_scanner = HokuyoParameters();
  parameters.second_scanner->mount.pose.yaw = M_PI;
  parameters.second_scanner->rate = 10.0;
  EXPECT_DOUBLE_EQ(parameters.longestScanPeriod(), 0.1);
  SimulatedRobot robot(world, parameters, {}, 1);
  Situation situation;
  for (const double scanned : {0.0, 0.0, 0.1}) {
    robot.sense(6.0, &situation);
    EXPECT_NEAR(situation.second.time, scanned, 1e-9);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Point2& point : situation.obstacles) nearest = std::min(nearest, std::hypot(point.x, point.y));
    EXPECT_NEAR(nearest, 1.5, 0.05);
    robot.advance(0.05);
  }
}

TEST(SimulatedRobot, TimePassesInWholeAndBrokenPeriods) {
  const CircleWorld world({});
  SimulatedRobot robot(world, {}, {}, 1);
  robot.advance(0.1);
  robot.advance(0.033);
  EXPECT_NEAR(robot.time(), 0.133, 1e-12);
}

TEST(SimulatedRobot, IsBumpedIntoWhenItStands) {
  const CircleWorld floor({});
  std::vector<Point2> places{{3.0, 0.0}};
  CrowdParameters parameters;
  parameters.walkers = 1;
  Crowd crowd(floor, places, parameters, {}, 1);
  places[0] = {-3.0, 0.0};  // from the second destination on
  SimulatedRobot robot(&crowd, {}, {}, 1);
  robot.advance(30.0);
  EXPECT_EQ(robot.contacts(), 0);
  EXPECT_EQ(robot.bumped(), 1);
  EXPECT_EQ(robot.bumpedMoving(), 0);
}

TEST(SimulatedRobot, HasAContactWhenItDrivesIntoAWalker) {
  const CircleWorld floor({});
  const std::vector<Point2> places{{2.0, 0.0}};
  CrowdParameters parameters;
  parameters.walkers = 1;
  Crowd crowd(floor, places, parameters, {}, 1);  // it has nowhere else to go
  SimulatedRobot robot(&crowd, {}, {}, 1);
  robot.command({0.3, 0.0});
  robot.advance(10.0);
  EXPECT_EQ(robot.contacts(), 1);
  EXPECT_EQ(robot.bumped(), 0);
  EXPECT_LT(robot.truePose().x, 2.0);
}

TEST(SimulatedRobot, IsBumpedIntoFromBehind) {
  const CircleWorld floor({});
  std::vector<Point2> places{{-2.0, 0.0}};
  CrowdParameters parameters;
  parameters.walkers = 1;
  parameters.slowest = parameters.fastest = 1.0;
  parameters.shortest_stand = parameters.longest_stand = 5.0;
  Crowd crowd(floor, places, parameters, {}, 1);
  places[0] = {8.0, 0.0};
  SimulatedRobot robot(&crowd, {}, {}, 1);
  robot.command({0.2, 0.0});
  robot.advance(4.0);
  EXPECT_EQ(robot.contacts(), 0);
  EXPECT_EQ(robot.bumped(), 1);
  EXPECT_EQ(robot.bumpedMoving(), 1);
  EXPECT_NEAR(robot.truePose().x, 0.8, 0.05) << "a bump does not stop it";
}

TEST(SimulatedRobot, PassingAWalkerWhoRanIntoItsSideIsNoContact) {
  const CircleWorld floor({});
  std::vector<Point2> places{{0.0, 2.0}};
  CrowdParameters parameters;
  parameters.walkers = 1;
  parameters.slowest = parameters.fastest = 1.0;
  parameters.shortest_stand = parameters.longest_stand = 5.0;
  Crowd crowd(floor, places, parameters, {}, 1);
  places[0] = {0.0, -2.0};
  SimulatedRobot robot(&crowd, {}, {}, 1);
  while (robot.bumped() == 0 && robot.time() < 30.0) robot.advance(0.02);
  robot.command({0.1, 0.0});
  robot.advance(2.0);
  EXPECT_EQ(robot.contacts(), 0);
  EXPECT_EQ(robot.bumped(), 1);
}

TEST(SimulatedRobot, ObeysCommandsWhenTheLatencyHasPassed) {
  const CircleWorld world({});
  SimulatedRobot::Parameters parameters;
  parameters.base.max_wheel_acceleration = 1e9;
  parameters.latency = 0.1;
  SimulatedRobot robot(world, parameters, {}, 1);
  robot.command({0.3, 0.0});
  robot.advance(0.1);
  EXPECT_EQ(robot.truePose().x, 0.0);
  robot.command({0.0, 0.0});  // on the way while the first one acts
  robot.advance(0.1);
  EXPECT_NEAR(robot.truePose().x, 0.03, 1e-9);
  robot.advance(1.0);
  EXPECT_NEAR(robot.truePose().x, 0.03, 1e-9);
}

TEST(SimulatedRobot, RefusesAPhysicsPeriodWithWhichTimeWouldNotPass) {
  const CircleWorld world({});
  SimulatedRobot::Parameters parameters;
  const auto refusal = [&] {
    return test::refusalOf<std::invalid_argument>([&] { SimulatedRobot(world, parameters, {}, 1); });
  };
  for (const double period : {0.0, -0.02, std::numeric_limits<double>::quiet_NaN()}) {
    parameters.physics_period = period;
    EXPECT_EQ(refusal().rfind("parameter physics_period is ", 0), 0u) << period << ": " << refusal();
  }
  parameters = {};
  parameters.latency = -0.1;
  EXPECT_EQ(refusal(), "parameter latency is -0.1, expected a number in [0, 10]");
}

}  // namespace
}  // namespace lstm_planner::test_simulated_robot
