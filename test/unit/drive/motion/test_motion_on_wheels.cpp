#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "lstm_planner/drive/motion/path_tracker.hpp"
#include "lstm_planner/simulation/simulated_robot.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/motion/motion_fixtures.hpp"
#include "unit/drive/motion/plan_along.hpp"

namespace lstm_planner::test_motion_on_wheels {
namespace {

constexpr double kPeriod = 0.1;  // s
constexpr double kRadius = 0.5;  // m
constexpr double kWall = 4.0;    // m, where it starts

/// A large, fast robot. Its wheels brake only as well as the controller is told that the robot does.
SimulatedRobot::Parameters largeRobot() {
  SimulatedRobot::Parameters parameters;
  parameters.base.base_diameter = 2.0 * kRadius;
  parameters.base.axle_length = 0.8;
  parameters.base.max_wheel_speed = 2.2;
  parameters.base.max_wheel_acceleration = 1.5;
  parameters.scanner.noise = 0.0;
  parameters.scanner.mount.pose = {};
  return parameters;
}

MotionParameters limitsOfLargeRobot() {
  MotionParameters limits = test::limitsOf(largeRobot().base, 1.5);
  limits.max_angular = 1.2;
  return limits;
}

/// Drives towards a wall, turning to the right; after `ticks` periods the plan leads to the left. Returns the contacts.
int contactsAfterATurn(int ticks, const World& world) {
  PathTracker tracker(limitsOfLargeRobot());
  SimulatedRobot robot(world, largeRobot(), {1.0, 6.0, 0.6}, 1);
  Shield shield(Footprint(kRadius), 0.03, 6.0);
  Situation situation;
  for (int tick = 0; tick < ticks + 30; ++tick) {
    robot.sense(6.0, &situation);
    shield.show(situation.obstacles);
    const double side = tick < ticks ? -1.0 : 1.0;
    const Point2 begin{situation.pose.x, situation.pose.y};
    const std::vector<Pose2> plan =
        test::planAlong({begin, pointAlong(situation.pose, situation.pose.yaw + side, 3.0)});
    robot.command(tracker.compute({plan, situation.pose, robot.measuredTwist(), shield, kPeriod}, situation));
    robot.advance(kPeriod);
  }
  return robot.contacts();
}

TEST(MotionOnWheels, ALargeRobotThatTurnsTheOtherWayBeforeAWallBrakesFirst) {
  // While one wheel brakes and the other speeds up, the robot turns the other way but does not become slower.
  OccupancyGrid grid = test::emptyHall(12.0, 12.0);
  test::fillBox(kWall, 0.0, kWall + 0.1, 12.0, &grid);
  const GridWorld world(grid);
  for (int ticks = 5; ticks <= 40; ++ticks) EXPECT_EQ(contactsAfterATurn(ticks, world), 0) << ticks;
}

/// How many walls, from 0.1 to 3 m before the robot, keep it from turning to the left as fast as without a wall.
int wallsThatHinder(double wheel_acceleration) {
  MotionParameters limits = limitsOfLargeRobot();
  limits.wheel_acceleration = wheel_acceleration;
  const MotionController controller(limits);
  Shield shield(Footprint(kRadius), 0.03, 6.0);
  const Twist2 before{1.2, -1.2};
  const std::vector<Pose2> plan = test::planAlong({{0.0, 0.0}, pointAlong(Point2{}, 1.0, 3.0)});
  const auto command = [&] {
    return controller.compute({plan, {}, before, shield, kPeriod}, {}, {}, {std::nullopt, false, {before}});
  };
  const double free_turn = command().angular;
  int walls = 0;
  for (double gap = 0.1; gap <= 3.0; gap += 0.1) {
    shield.show(test::wall({kRadius + gap, -4.0}, {kRadius + gap, 4.0}));
    walls += command().angular < free_turn;
  }
  return walls;
}

TEST(MotionOnWheels, AnOdometryThatSaysWhatNoRobotDrivesIsAnsweredInTime) {
  const MotionController controller(limitsOfLargeRobot());
  const std::vector<Pose2> plan = test::planAlong({{0.0, 0.0}, {3.0, 0.0}});
  const std::vector<Point2> corners = {{0.3, 0.2}, {-0.3, 0.2}, {-0.3, -0.2}, {0.3, -0.2}};
  for (const Footprint& footprint : {Footprint(kRadius), Footprint(corners)}) {
    const Shield shield(footprint, 0.03, 6.0);
    for (const Twist2& twist : {Twist2{1e9, 0.0}, Twist2{0.0, -1e9}, Twist2{-1e9, 1e9}}) {
      EXPECT_TRUE(std::isfinite(controller.compute({plan, {}, twist, shield, kPeriod}).linear));
    }
  }
}

TEST(MotionOnWheels, TheSlowerItsWheelsTheEarlierARobotBrakesBeforeItTurns) {
  const int as_told = wallsThatHinder(0.0);
  EXPECT_EQ(as_told, wallsThatHinder(limitsOfLargeRobot().linear_acceleration));
  EXPECT_LT(as_told, wallsThatHinder(0.75));
  EXPECT_GT(as_told, wallsThatHinder(6.0));
}

}  // namespace
}  // namespace lstm_planner::test_motion_on_wheels
