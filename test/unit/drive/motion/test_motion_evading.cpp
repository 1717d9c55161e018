// A robot that gets out of the way of what comes.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lstm_planner/common/arc.hpp"
#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "unit/drive/motion/motion_fixtures.hpp"
#include "unit/drive/motion/plan_along.hpp"

namespace lstm_planner::test_motion_evading {
namespace {

using test::planAlong;

constexpr double kPeriod = 0.1;
constexpr double kMargin = 0.03;

MotionParameters fastMotion(double evade_time) {
  MotionParameters motion = test::limitsOfJackal();
  motion.evade_time = evade_time;
  return motion;
}

/// For both footprints: a circle, and the Jackal's polygon.
class MotionEvading : public ::testing::TestWithParam<bool> {
 protected:
  static Footprint footprint() { return GetParam() ? test::jackal() : Footprint(0.3); }
  MotionCommand evade(const std::vector<MovingThing>& things, const MotionCommand& command = {},
                      const Twist2& current = {}) const {
    return controller_.evade(command, {plan_, {}, current, shield_, kPeriod}, things);
  }
  /// Where a robot ends that asks again all the time, with the least distance to the thing on its way; it obeys at
  /// once.
  double leastRoom(MovingThing thing, double seconds) const {
    Pose2 pose;
    Twist2 twist;
    double least = 1e9;
    for (double time = 0.0; time < seconds; time += kPeriod) {
      MovingThing local = thing;
      local.center = toLocalFrame(pose, thing.center);
      local.velocity = toLocalFrame({0.0, 0.0, pose.yaw}, thing.velocity);
      const MotionCommand command = controller_.evade({}, {plan_, pose, twist, shield_, kPeriod}, {local});
      twist.linear += std::max(-0.2, std::min(0.2, command.linear - twist.linear));
      twist.angular = command.angular;
      pose = alongTurn(pose, twist.linear * kPeriod, twist.angular * kPeriod);
      thing.center.x += kPeriod * thing.velocity.x;
      thing.center.y += kPeriod * thing.velocity.y;
      least = std::min(least, footprint().distanceTo(toLocalFrame(pose, thing.center)) - thing.radius);
    }
    return least;
  }

  MotionController controller_{fastMotion(2.5)};
  Shield shield_{footprint(), kMargin, 6.0};
  std::vector<Pose2> plan_ = planAlong({{0.0, 0.0}, {6.0, 0.0}});
};

TEST_P(MotionEvading, GetsOutOfTheWayOfWhatComesFromEachSide) {
  for (const double degrees : {0.0, 45.0, 90.0, 180.0}) {
    MovingThing thing{pointAlong(Point2{}, degreesToRadians(degrees), 4.0), 0.5, {}};
    thing.velocity = {-thing.center.x / 4.0, -thing.center.y / 4.0};  // 1 m/s, straight to the robot
    EXPECT_GT(leastRoom(thing, 5.0), 0.1) << degrees;
  }
}

TEST_P(MotionEvading, WithoutATimeItStandsAndWaits) {
  const MotionController waits(fastMotion(0.0));
  const MotionCommand command = waits.evade({}, {plan_, {}, {}, shield_, kPeriod}, {{{2.0, 0.0}, 0.5, {-1.0, 0.0}}});
  EXPECT_EQ(command.linear, 0.0);
  EXPECT_EQ(command.angular, 0.0);
}

TEST_P(MotionEvading, WhatPassesByChangesNothing) {
  const MotionCommand command{{1.0, 0.1}, StopReason::kNone};
  for (const MovingThing& thing :
       {MovingThing{{3.0, 2.0}, 0.5, {0.0, 1.0}}, MovingThing{{-2.0, 0.0}, 0.5, {-1.0, 0.0}}}) {
    const MotionCommand same = evade({thing}, command, {1.0, 0.1});
    EXPECT_EQ(same.linear, command.linear);
    EXPECT_EQ(same.angular, command.angular);
  }
}

TEST_P(MotionEvading, DoesNotDriveIntoWhatItWouldCrossThePathOf) {
  // It comes from the left to where the robot will be in 1.5 s.
  const MotionCommand ahead{{2.0, 0.0}, StopReason::kNone};
  const MotionCommand command = evade({{{3.0, 3.0}, 0.5, {0.0, -2.0}}}, ahead, {2.0, 0.0});
  EXPECT_TRUE(command.linear < 1.5 || std::abs(command.angular) > 0.3) << command.linear << " " << command.angular;
}

TEST_P(MotionEvading, BacksAwayAsFarAsItIsSeenFreeBehind) {
  // Between two walls something comes straight towards it; turning round takes longer.
  std::vector<Point2> walls;
  for (double x = -4.0; x <= 4.0; x += 0.05) {
    walls.push_back({x, 0.45});
    walls.push_back({x, -0.45});
  }
  Shield shield(footprint(), kMargin, 6.0);
  shield.show(walls);
  const MotionSituation stands{plan_, {}, {}, shield, kPeriod};
  const MovingThing comes{{2.0, 0.0}, 0.4, {-1.0, 0.0}};
  const MotionCommand away = controller_.evade({}, stands, {comes}, 4.0);
  EXPECT_LT(away.linear, -0.5);
  EXPECT_EQ(away.angular, 0.0);
  EXPECT_TRUE(away.goes_back) << "nothing of it is a path that it came";
  EXPECT_GE(controller_.evade({}, stands, {comes}).linear, 0.0) << "what is behind is not seen";
  // It stands within 0.2 m: 0.25 s of reaction, and 2 m/s^2.
  const double slow = -controller_.evade({}, stands, {comes}, 0.2).linear;
  EXPECT_LE(0.25 * slow + slow * slow / 4.0, 0.2 + 1e-9);
  walls.push_back({-0.5, 0.0});
  shield.show(walls);
  const double blocked = -controller_.evade({}, stands, {comes}, 4.0).linear;
  EXPECT_LE(0.25 * blocked + blocked * blocked / 4.0, 0.5 - kMargin - 0.25);
}

TEST_P(MotionEvading, NeverTurnsAndBacksWhateverTurnsInPlaceMeans) {
  MotionParameters motion = fastMotion(2.5);
  motion.turn_in_place = 4.0;
  const MotionController controller(motion);
  for (int degrees = -180; degrees < 180; degrees += 15) {
    MovingThing thing{pointAlong(Point2{}, degreesToRadians(degrees), 2.0), 0.5, {}};
    thing.velocity = {-0.5 * thing.center.x, -0.5 * thing.center.y};
    EXPECT_GE(controller.evade({}, {plan_, {}, {}, shield_, kPeriod}, {thing}).linear, 0.0) << degrees;
  }
}

TEST_P(MotionEvading, DoesNotFleeIntoAnObstacle) {
  // Walls ahead and on both sides: there is no way out.
  std::vector<Point2> walls;
  for (double along = -0.5; along <= 0.5; along += 0.02) {
    walls.push_back({0.5, along});
    walls.push_back({along, 0.5});
    walls.push_back({along, -0.5});
  }
  Shield shield(footprint(), kMargin, 6.0);
  shield.show(walls);
  const MotionCommand command =
      controller_.evade({}, {plan_, {}, {}, shield, kPeriod}, {{{-2.5, 0.0}, 0.5, {1.0, 0.0}}});
  EXPECT_LT(command.linear, 0.3);  // 0.2 m of room ahead less the margin, reaction and braking
}

INSTANTIATE_TEST_SUITE_P(Footprints, MotionEvading, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "Polygon" : "Circle"; });

}  // namespace
}  // namespace lstm_planner::test_motion_evading
