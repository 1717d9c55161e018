// The controller and what tells it what moves, in closed loop with a simulated robot.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "lstm_planner/drive/motion/path_tracker.hpp"
#include "lstm_planner/drive/perception/moving_returns.hpp"
#include "lstm_planner/simulation/simulated_robot.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/motion/plan_along.hpp"

namespace lstm_planner::test_motion_among_people {
namespace {

using test::planAlong;

constexpr double kPeriod = 0.1;
constexpr double kRadius = 0.17425;

/// Drives from the origin of the odometry towards a goal straight ahead, 0.1 s of latency, among things that move.
class AmongPersons {
 public:
  AmongPersons(const World& world, const Pose2& start, double goal)
      : robot_(world, parameters(), start, 3), plan_(planAlong({{0.0, 0.0}, {goal, 0.0}})) {}

  void step() {
    robot_.sense(6.0, &situation_);
    shield_.show(situation_.obstacles);
    moving_.show(situation_.profile, situation_.pose, situation_.time);
    robot_.command(controller_.compute({plan_, situation_.pose, robot_.measuredTwist(), shield_, kPeriod},
                                       moving_.points(), moving_.resting()));
    robot_.advance(kPeriod);
  }
  const SimulatedRobot& robot() const { return robot_; }
  double speed() const { return robot_.measuredTwist().linear; }

 private:
  static SimulatedRobot::Parameters parameters() {
    SimulatedRobot::Parameters parameters;
    parameters.latency = 0.1;
    return parameters;
  }
  SimulatedRobot robot_;
  std::vector<Pose2> plan_;
  MotionController controller_{MotionParameters{}};
  MovingReturns moving_{MovingReturnsParameters{}};
  Shield shield_{Footprint(kRadius), 0.03, 2.5};
  Situation situation_;
};

const World& hall() {
  static const GridWorld world(test::emptyHall(12.0, 8.0));
  return world;
}

/// A hall with one person who is moved from outside.
struct HallWithPerson : CircleWorld {
  explicit HallWithPerson(const Point2& center) : CircleWorld({{center, 0.25}}, &hall()) {}
  Point2& person() { return circles().front().center; }
};

TEST(MotionAmongPeople, StandsBeforeAPersonWhoComesStraightTowardsItReachesIt) {
  for (const double speed : {0.4, 0.7, 1.0}) {
    HallWithPerson world({8.0, 4.0});
    AmongPersons drive(world, {1.5, 4.0, 0.0}, 9.0);
    while (drive.robot().contacts() == 0 && drive.robot().time() < 20.0) {
      drive.step();
      world.person().x -= speed * kPeriod;
    }
    EXPECT_NEAR(drive.speed(), 0.0, 0.025) << speed;      // an encoder tick
    EXPECT_GT(drive.robot().pathLength(), 0.5) << speed;  // it did drive before
  }
}

/// The speed of a robot that stood and watched somebody come towards it until the body's middle was `person` m ahead,
/// and that has come `way` m since the last scan.
double speedBeforeSomebody(double person, double way) {
  HallWithPerson world({3.0 + person, 4.0});
  SimulatedRobot robot(world, {}, {1.5, 4.0, 0.0}, 3);
  PathTracker tracker{MotionParameters{}};
  Shield shield(Footprint(kRadius), 0.03, 2.5);
  Situation situation;
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {6.0, 0.0}});
  double speed = 0.0;
  while (robot.time() < 1.5 - 0.5 * kPeriod) {
    robot.advance(kPeriod);
    world.person().x -= kPeriod;
    robot.sense(6.0, &situation);
    const bool is_last = robot.time() > 1.5 - 0.5 * kPeriod;
    const Pose2 now{is_last ? way : 0.0, 0.0, 0.0};
    shield.show(situation.obstacles);
    shield.moveTo(now);
    speed = tracker.compute({plan, now, {0.3, 0.0}, shield, kPeriod}, situation).linear;
  }
  return speed;
}

TEST(MotionAmongPeople, KnowsHowFarTheRobotHasComeTowardsAPersonSinceTheScan) {
  constexpr double kWay = 0.2;  // m
  // A way is 1 s a metre less time to brake before somebody who comes at 1 m/s; ranges have three times their noise.
  const double braking = MotionParameters{}.linear_acceleration / MotionParameters{}.person_speed;
  const double noise = braking * 3.0 * HokuyoParameters{}.noise;
  const double before = speedBeforeSomebody(1.3, 0.0);
  EXPECT_GT(before, 0.15);
  EXPECT_LT(speedBeforeSomebody(1.3, kWay), before - braking * kWay + noise);
  EXPECT_NEAR(speedBeforeSomebody(1.3, kWay), speedBeforeSomebody(1.3 - kWay, 0.0), noise);
}

TEST(MotionAmongPeople, WaitsForAPersonWhoCrossesAndThenGoesOn) {
  HallWithPerson world({3.6, 1.0});
  AmongPersons drive(world, {1.5, 4.0, 0.0}, 6.0);
  double slowest = 1.0;
  while (drive.robot().time() < 35.0) {
    drive.step();
    world.person().y = std::min(7.0, world.person().y + 0.5 * kPeriod);
    if (drive.robot().time() > 3.0 && drive.robot().time() < 9.0) slowest = std::min(slowest, drive.speed());
  }
  EXPECT_EQ(drive.robot().contacts(), 0);
  EXPECT_LT(slowest, 0.1);
  EXPECT_GT(drive.robot().truePose().x, 7.0);
}

TEST(MotionAmongPeople, PassesAPersonWhoHasStoodStillForAWhile) {
  HallWithPerson world({5.0, 1.5});
  AmongPersons drive(world, {1.5, 4.0, 0.0}, 6.0);
  while (drive.robot().time() < 30.0) {
    drive.step();
    // Comes to stand 0.2 m beside the robot's path.
    world.person().y = std::min(4.0 - 0.25 - kRadius - 0.2, world.person().y + 0.5 * kPeriod);
  }
  EXPECT_EQ(drive.robot().contacts(), 0);
  EXPECT_GT(drive.robot().truePose().x, 7.0);
}

TEST(MotionAmongPeople, GetsAwayFromAPersonWhoHasComeWithinItsMargin) {
  // Someone stands 1 cm before the footprint; the plan leads aside or back: turn, then leave, never nearer.
  for (const double degrees : {120.0, 180.0, -135.0}) {
    HallWithPerson world({1.5 + kRadius + 0.26, 4.0});
    SimulatedRobot::Parameters parameters;
    SimulatedRobot robot(world, parameters, {1.5, 4.0, 0.0}, 5);
    const Point2 goal = pointAlong(Point2{}, degreesToRadians(degrees), 1.0);
    const MotionController controller{MotionParameters{}};
    Shield shield(Footprint(kRadius), 0.03, 2.5);
    Situation situation;
    double nearest = 1.0;
    while (robot.time() < 15.0) {
      robot.sense(6.0, &situation);
      shield.show(situation.obstacles);
      const std::vector<Pose2> plan = planAlong({{situation.pose.x, situation.pose.y}, goal});
      robot.command(controller.compute({plan, situation.pose, robot.measuredTwist(), shield, kPeriod}));
      robot.advance(kPeriod);
      nearest = std::min(nearest, distanceBetween(robot.truePose(), world.person()) - 0.25 - kRadius);
    }
    EXPECT_EQ(robot.contacts(), 0) << degrees;
    EXPECT_GT(nearest, 0.009) << degrees;
    EXPECT_LT(distanceBetween(robot.odometry(), goal), 0.25) << degrees;
  }
}

}  // namespace
}  // namespace lstm_planner::test_motion_among_people
