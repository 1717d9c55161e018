#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <stdexcept>

#include "lstm_planner/drive/motion/motion_controller.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"
#include "unit/drive/motion/plan_along.hpp"

namespace lstm_planner::test_motion_controller {
namespace {

constexpr double kPeriod = 0.1;
constexpr double kRadius = 0.17425;
const double kNan = std::numeric_limits<double>::quiet_NaN();

using test::planAlong;

class MotionControllerTest : public ::testing::Test {
 protected:
  MotionControllerTest() : controller_(MotionParameters{}), shield_(Footprint(kRadius), 0.03, 2.5) {}

  Twist2 compute(const std::vector<Pose2>& plan, const Pose2& pose = {}, const Twist2& current = {0.3, 0.0}) const {
    return controller_.compute({plan, pose, current, shield_, kPeriod});
  }

  MotionController controller_;
  Shield shield_;
};

TEST_F(MotionControllerTest, DrivesAlongAStraightPlan) {
  const Twist2 twist = compute(planAlong({{0.0, 0.0}, {5.0, 0.0}}));
  EXPECT_DOUBLE_EQ(twist.linear, controller_.parameters().max_linear);
  EXPECT_NEAR(twist.angular, 0.0, 1e-12);
}

TEST_F(MotionControllerTest, SpeedsUpNoFasterThanItsAcceleration) {
  EXPECT_NEAR(compute(planAlong({{0.0, 0.0}, {5.0, 0.0}}), {}, {0.0, 0.0}).linear, 0.06, 1e-12);
  EXPECT_NEAR(compute(planAlong({{0.0, 0.0}, {5.0, 0.0}}), {}, {0.1, 0.0}).linear, 0.16, 1e-12);
}

TEST_F(MotionControllerTest, TurnsInPlaceTowardsAPlanBehind) {
  const Twist2 left = compute(planAlong({{0.0, 0.0}, {-5.0, 0.5}}));
  EXPECT_EQ(left.linear, 0.0);
  EXPECT_DOUBLE_EQ(left.angular, controller_.parameters().max_angular);
  const Twist2 right = compute(planAlong({{0.0, 0.0}, {-5.0, -0.5}}));
  EXPECT_EQ(right.linear, 0.0);
  EXPECT_DOUBLE_EQ(right.angular, -controller_.parameters().max_angular);
}

TEST_F(MotionControllerTest, FollowsAPlanThatTurnsBackToWhereItTurns) {
  // Both branches are within the lookahead; the second lies on the robot and leads backwards.
  const Twist2 twist = compute(planAlong({{0.0, 0.0}, {0.2, 0.0}, {-2.0, 0.0}}));
  EXPECT_GT(twist.linear, 0.0);
  EXPECT_NEAR(twist.angular, 0.0, 1e-9);
}

TEST_F(MotionControllerTest, FollowsAPlanOfCornersOnly) {
  const std::vector<Pose2> corners = {{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {2.0, 2.0, 0.0}};
  for (const double driven : {0.1, 0.5, 1.5}) {
    for (const bool is_open : {true, false}) {
      shield_.show(is_open ? std::vector<Point2>() : std::vector<Point2>{{2.2 - driven, 0.0}});
      const Twist2 twist = compute(corners, {driven, 0.02, 0.0});
      EXPECT_GT(twist.linear, 0.1) << driven;
      EXPECT_NEAR(twist.angular, 0.0, 0.2) << driven;
    }
  }
}

TEST_F(MotionControllerTest, FindsItsPlaceOnAnOldPlan) {
  const Twist2 twist = compute(planAlong({{0.0, 0.0}, {5.0, 0.0}, {5.0, 3.0}}), {4.0, 0.02, 0.0});
  EXPECT_GT(twist.linear, 0.29);
  EXPECT_NEAR(twist.angular, 0.0, 0.2);
}

TEST_F(MotionControllerTest, DoesNotCutACornerThroughAnObstacle) {
  // The plan goes 0.25 m on and then to the left; a post stands inside the corner.
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {0.25, 0.0}, {0.25, 2.0}});
  EXPECT_GT(compute(plan).angular, 0.5);
  shield_.show({{0.03, 0.22}});
  EXPECT_LT(compute(plan).angular, 0.5);
}

TEST_F(MotionControllerTest, StopsBeforeAnObstacle) {
  shield_.show({{kRadius + 0.035, 0.0}});  // 5 mm before the safety margin
  EXPECT_EQ(compute(planAlong({{0.0, 0.0}, {5.0, 0.0}})).linear, 0.0);
  shield_.show({{-kRadius - 0.035, 0.0}});
  EXPECT_GT(compute(planAlong({{0.0, 0.0}, {5.0, 0.0}})).linear, 0.0);
}

TEST_F(MotionControllerTest, IsSlowerWithALateOdometryAndBeforePeopleBehindASlowScanner) {
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {5.0, 0.0}});
  const std::vector<Point2> somebody = {{kRadius + 0.8, 0.0}};
  shield_.show({{kRadius + 0.15, 0.0}});
  const double before_wall = compute(plan).linear;
  controller_.expectReactionTime(0.1, 0.1);
  EXPECT_DOUBLE_EQ(compute(plan).linear, before_wall) << "shorter than the parameter: that one counts";
  controller_.expectReactionTime(0.1, 0.4);
  EXPECT_DOUBLE_EQ(compute(plan).linear, before_wall);
  controller_.expectReactionTime(0.4, 0.4);
  EXPECT_LT(compute(plan).linear, before_wall);
  shield_.show({});
  const auto beforeSomebody = [&](double scan_age) {
    controller_.expectReactionTime(0.1, scan_age);
    return controller_.compute({plan, {}, {}, shield_, 0.1}, somebody).linear;
  };
  EXPECT_LT(beforeSomebody(0.6), beforeSomebody(0.1));
}

TEST_F(MotionControllerTest, SlowsDownOnItsPathTowardsAnObstacleButNotBesideOne) {
  const MotionParameters& limits = controller_.parameters();
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {5.0, 0.0}});
  shield_.show(test::wall({-1.0, kRadius + 0.05}, {1.0, kRadius + 0.05}));
  EXPECT_DOUBLE_EQ(compute(plan).linear, limits.max_linear);
  shield_.show(test::wall({-1.0, kRadius + 0.4}, {1.0, kRadius - 0.2}));  // comes nearer, 0.3 m a metre
  EXPECT_LT(compute(plan).linear, limits.max_linear);
}

TEST_F(MotionControllerTest, DrivesOnWhileItTurns) {
  const Twist2 twist = compute(planAlong({{0.0, 0.0}, {3.0, 4.0}}));  // 0.93 rad to the left
  EXPECT_GT(twist.linear, 0.1);
  EXPECT_GT(twist.angular, 1.0);
}

TEST_F(MotionControllerTest, BrakesBeforeAPostOnItsArcAndThenTurns) {
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {3.0, 4.0}});
  shield_.show({{0.2, 0.15}, {kRadius + 0.035, 0.0}});
  EXPECT_EQ(compute(plan).linear, 0.0);
  EXPECT_EQ(compute(plan).angular, 0.0) << "it would keep its speed for longer";
  EXPECT_LT(compute(plan, {}, {}).linear, 0.01) << "5 mm are free";
  EXPECT_GT(compute(plan, {}, {}).angular, 1.0);
}

TEST_F(MotionControllerTest, KeepsItsArcWhereAWheelIsAtItsLimit) {
  MotionParameters parameters;
  parameters.max_wheel_speed = 0.35;
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {2.0, 1.0}});
  const Twist2 wide = compute(plan);
  controller_ = MotionController(parameters);
  const Twist2 clipped = compute(plan);
  EXPECT_NEAR(clipped.linear + 0.5 * parameters.axle_length * clipped.angular, 0.35, 1e-12);
  EXPECT_NEAR(clipped.angular / clipped.linear, wide.angular / wide.linear, 1e-9);
}

TEST_F(MotionControllerTest, TurnsTheSameWayWhereCommandsTakeTheirTime) {
  // The plan lies behind, a little to the right. What is measured is the command before the last one; and a robot whose
  // wheels are told to and fro does not even brake.
  Twist2 under_way;
  Twist2 measured{0.13, 0.7};
  for (int i = 0; i < 10; ++i) {
    const Twist2 twist = compute(planAlong({{0.0, 0.0}, {-3.0, -0.3}}), {}, measured);
    ASSERT_DOUBLE_EQ(twist.angular, -controller_.parameters().max_angular);
    measured = under_way;
    under_way = twist;
  }
}

TEST_F(MotionControllerTest, LooksAtThePathThatItTakesUntilTheCommandActs) {
  // A post stands to the left, where it does not matter to a robot that goes straight on; but one that turns there now
  // and starts the straight arc late is led to it.
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {5.0, 0.0}});
  shield_.show({pointAlong(Point2{}, 1.3, kRadius + 0.06)});
  const double straight_on = compute(plan, {}, {0.2, 0.0}).linear;
  const double turning = compute(plan, {}, {0.2, 2.0}).linear;
  EXPECT_GT(straight_on, 0.2);
  EXPECT_LT(turning, straight_on);
}

TEST_F(MotionControllerTest, StandsStillWithoutAPlanOrAPose) {
  for (const Twist2& twist :
       {compute({}), compute(planAlong({{0.0, 0.0}, {5.0, 0.0}}), {kNan, 0.0, 0.0}),
        compute(planAlong({{0.0, 0.0}, {5.0, 0.0}}), {0.0, 0.0, kNan}), compute({{kNan, 0.0, 0.0}}),
        compute({{0.0, 0.0, 0.0}, {5.0, kNan, 0.0}}), compute({{0.1, 0.0, kNan}})}) {
    EXPECT_EQ(twist.linear, 0.0);
    EXPECT_EQ(twist.angular, 0.0);
  }
}

TEST_F(MotionControllerTest, KeepsItsLimitsWhateverThePlan) {
  const MotionParameters& limits = controller_.parameters();
  for (int degrees = -180; degrees < 180; degrees += 5) {
    for (const double length : {0.25, 0.5, 5.0}) {
      const Point2 end = pointAlong(Point2{}, degreesToRadians(degrees), length);
      const Twist2 twist = compute(planAlong({{0.0, 0.0}, end}), {}, {0.5, 3.0});
      ASSERT_GE(twist.linear, 0.0);
      ASSERT_LE(twist.linear, limits.max_linear);
      ASSERT_LE(std::abs(twist.angular), limits.max_angular);
    }
  }
}

TEST_F(MotionControllerTest, KeepsItsLimitsBesideAnObstacleWhileItIsTurnedFasterThanTheyAllow) {
  const double limit = controller_.parameters().max_angular;
  for (int degrees = -180; degrees < 180; degrees += 15) {
    const Point2 obstacle = pointAlong(Point2{}, degreesToRadians(degrees), kRadius + 0.045);
    shield_.show({obstacle});
    const Twist2 twist = compute(planAlong({{0.0, 0.0}, {-0.25, 0.0}}), {}, {0.1, 1.5 * limit});
    EXPECT_LE(std::abs(twist.angular), limit) << degrees;
  }
}

TEST_F(MotionControllerTest, ReachesTheGoalWithAnyHeadingByDefault) {
  EXPECT_TRUE(controller_.goalReached({0.0, 0.0, 3.0}, {0.19, 0.0, 0.0}));
  EXPECT_FALSE(controller_.goalReached({0.0, 0.0, 0.0}, {0.21, 0.0, 0.0}));
  EXPECT_EQ(compute({{0.0, 0.0, 0.0}, {0.1, 0.0, 2.0}}).angular, 0.0);
}

TEST_F(MotionControllerTest, TurnsToTheGoalsHeadingWhereItIsAskedFor) {
  MotionParameters parameters;
  parameters.heading_tolerance = 0.2;
  controller_ = MotionController(parameters);
  EXPECT_TRUE(controller_.goalReached({0.0, 0.0, 0.1}, {0.1, 0.0, 0.0}));
  EXPECT_FALSE(controller_.goalReached({0.0, 0.0, 0.3}, {0.1, 0.0, 0.0}));
  EXPECT_TRUE(controller_.goalReached({0.0, 0.0, 3.1}, {0.1, 0.0, -3.1}));  // 0.08 rad across the cut
  const Twist2 twist = compute({{0.0, 0.0, 0.0}, {0.1, 0.0, -2.0}});
  EXPECT_EQ(twist.linear, 0.0);
  EXPECT_DOUBLE_EQ(twist.angular, -parameters.max_angular);
  EXPECT_EQ(compute({{0.0, 0.0, 0.0}, {0.1, 0.0, 0.1}}).angular, 0.0);
}

TEST_F(MotionControllerTest, StopsInTimeFromFullSpeedWithTheWorstReactionTime) {
  // The wall stands 2.5 m ahead, every plan leads through it. Commands take effect 0.15 s after the scan that they rest
  // on and hold for 0.1 s: the last moment that one acts is the reaction time of 0.25 s after its scan.
  OccupancyGrid grid = test::emptyHall(8.0, 4.0);
  test::fillBox(4.0, 0.0, 4.1, 4.0, &grid);
  const GridWorld world(grid);
  SimulatedRobot::Parameters parameters;
  parameters.scanner.noise = 0.0;
  SimulatedRobot robot(world, parameters, {1.5, 2.0, 0.0}, 1);
  std::deque<Twist2> under_way(3);  // 0.05 s each
  Situation situation;
  double fastest = 0.0;
  for (int tick = 0; tick < 400; ++tick) {
    if (tick % 2 == 0) {
      robot.sense(6.0, &situation);
      shield_.show(situation.obstacles);
      const std::vector<Pose2> plan = planAlong({{situation.pose.x, situation.pose.y}, {6.0, 0.0}});
      under_way.push_back(controller_.compute({plan, situation.pose, robot.measuredTwist(), shield_, kPeriod}));
    } else {
      under_way.push_back(under_way.back());
    }
    robot.command(under_way.front());
    under_way.pop_front();
    robot.advance(0.05);
    fastest = std::max(fastest, robot.measuredTwist().linear);
  }
  EXPECT_EQ(robot.contacts(), 0);
  EXPECT_GT(fastest, 0.28);
  const double gap = 4.0 - robot.truePose().x - kRadius;
  EXPECT_GE(gap, controller_.parameters().safety_margin);
  EXPECT_LT(gap, 0.1);  // and it does drive up to it
  EXPECT_NEAR(robot.measuredTwist().linear, 0.0, 1e-9);
}

TEST_F(MotionControllerTest, IsNeverFasterThanLetsItStandBeforeAPersonComes) {
  const MotionParameters& limits = controller_.parameters();
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {5.0, 0.0}});
  double before = limits.max_linear;
  for (double gap = 1.5; gap > 0.0; gap -= 0.01) {
    const std::vector<Point2> person = {{kRadius + gap, 0.0}};
    const double speed = controller_.compute({plan, {}, {0.3, 0.0}, shield_, kPeriod}, person).linear;
    const double time = limits.reaction_time + speed / limits.linear_acceleration;
    const double path = speed * limits.reaction_time + speed * speed / (2.0 * limits.linear_acceleration);
    ASSERT_TRUE(speed == 0.0 || gap - path - limits.person_speed * time >= limits.person_margin - 1e-9) << gap;
    ASSERT_LE(speed, before) << gap;
    before = speed;
  }
  EXPECT_EQ(before, 0.0);
  EXPECT_DOUBLE_EQ(controller_.compute({plan, {}, {0.3, 0.0}, shield_, kPeriod}, {{kRadius + 1.1, 0.0}}).linear,
                   limits.max_linear);
}

TEST_F(MotionControllerTest, IsSlowBesideAPersonWhoStands) {
  const MotionParameters& limits = controller_.parameters();
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {5.0, 0.0}});
  const std::vector<Point2> person = {{0.0, kRadius + 0.09}};
  const Twist2 current{0.3, 0.0};
  EXPECT_DOUBLE_EQ(controller_.compute({plan, {}, current, shield_, kPeriod}, {}, person).linear,
                   limits.person_slow_speed);
  EXPECT_EQ(controller_.compute({plan, {}, current, shield_, kPeriod}, person).linear, 0.0) << "this one moves";
  EXPECT_DOUBLE_EQ(controller_.compute({plan, {}, current, shield_, kPeriod}, {}, {{0.0, kRadius + 1.1}}).linear,
                   limits.max_linear);
}

TEST_F(MotionControllerTest, StandsBeforeAPersonBeforeItTurns) {
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {3.0, 3.0}});
  const std::vector<Point2> person = {{0.3, 0.0}};
  EXPECT_EQ(controller_.compute({plan, {}, {0.2, 0.0}, shield_, kPeriod}, person).angular, 0.0);
  EXPECT_GT(controller_.compute({plan, {}, {0.0, 0.0}, shield_, kPeriod}, person).angular, 1.0);
}

TEST_F(MotionControllerTest, TurnsThoughAPersonIsNear) {
  const Twist2 twist =
      controller_.compute({planAlong({{0.0, 0.0}, {0.0, 5.0}}), {}, {}, shield_, kPeriod}, {{0.3, 0.0}});
  EXPECT_EQ(twist.linear, 0.0);
  EXPECT_GT(twist.angular, 1.0);
}

TEST_F(MotionControllerTest, SaysWhyItDoesNotDrive) {
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {5.0, 0.0}});
  const std::vector<Point2> person = {{kRadius + 0.2, 0.0}};
  EXPECT_EQ(controller_.compute({plan, {}, {}, shield_, kPeriod}).stop, StopReason::kNone);
  EXPECT_EQ(controller_.compute({{}, {}, {}, shield_, kPeriod}).stop, StopReason::kNoPlan);
  EXPECT_EQ(controller_.compute({plan, {5.0, 0.0, 0.0}, {}, shield_, kPeriod}).stop, StopReason::kArrived);
  EXPECT_EQ(controller_.compute({plan, {kNan, 0.0, 0.0}, {}, shield_, kPeriod}).stop, StopReason::kUnusableData);
  EXPECT_EQ(controller_.compute({plan, {}, {}, shield_, 0.0}).stop, StopReason::kUnusableData);
  EXPECT_EQ(controller_.compute({plan, {}, {}, shield_, kPeriod}, person).stop, StopReason::kPerson);
  EXPECT_EQ(controller_.compute({plan, {}, {0.3, 0.0}, shield_, kPeriod}, person).stop, StopReason::kPerson);
  shield_.show({{kRadius + 0.02, 0.0}});
  EXPECT_EQ(controller_.compute({plan, {}, {}, shield_, kPeriod}).stop, StopReason::kObstacle);
  EXPECT_EQ(controller_.compute({planAlong({{0.0, 0.0}, {0.0, 5.0}}), {}, {}, shield_, kPeriod}).stop,
            StopReason::kNone)
      << "it turns away";
}

TEST_F(MotionControllerTest, TurnsToItsPlanWhereCommandsAreLongOnTheirWay) {
  MotionParameters parameters;
  parameters.reaction_time = 0.8;  // 0.7 s of a velocity smoother
  const MotionController controller(parameters);
  const std::vector<Pose2> plan = planAlong({{0.0, 0.0}, {0.0, 3.0}});
  Create2 robot({}, {}, 1);
  std::deque<Twist2> on_their_way(7);
  for (int i = 0; i < 300; ++i) {
    on_their_way.push_back(controller.compute({plan, robot.truePose(), robot.measuredTwist(), shield_, kPeriod}));
    robot.command(on_their_way.front());
    on_their_way.pop_front();
    robot.step(kPeriod);
  }
  EXPECT_TRUE(controller.goalReached(robot.truePose(), plan.back())) << "it turned to and fro";
}

TEST_F(MotionControllerTest, RefusesLimitsThatAreNotPositive) {
  MotionParameters parameters;
  parameters.max_linear = 0.0;
  EXPECT_THROW(MotionController{parameters}, std::invalid_argument);
  parameters.max_linear = kNan;
  EXPECT_THROW(MotionController{parameters}, std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_motion_controller
