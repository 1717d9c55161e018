#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lstm_planner/common/arc.hpp"
#include "lstm_planner/drive/motion/path_tracker.hpp"
#include "unit/drive/motion/motion_fixtures.hpp"
#include "unit/drive/motion/plan_along.hpp"

namespace lstm_planner::test_path_tracker {
namespace {

constexpr double kPatience = 5.0;  // s
constexpr double kPeriod = 0.1;    // s

/// A round robot that stands, held, between returns ahead and behind.
class PathTrackerTest : public ::testing::Test {
 protected:
  PathTrackerTest() : tracker_(withPatience()), shield_(Footprint(0.17), 0.03, 4.0) {
    situation_.obstacles = {{0.18, 0.0}, {-0.18, 0.0}};
    shield_.show(situation_.obstacles);
  }

  static MotionParameters withPatience() {
    MotionParameters motion;
    motion.patience = kPatience;
    return motion;
  }

  /// The answer to a plan to the same goal that begins in that direction (rad), after so many seconds of it.
  StopReason follow(double direction, double seconds) {
    const Point2 next = pointAlong(Point2{}, direction, 0.5);
    const std::vector<Pose2> plan{{}, {next.x, next.y, 0.0}, {3.0, 0.0, 0.0}};
    StopReason stop = StopReason::kNone;
    for (double passed = 0.0; passed < seconds; passed += kPeriod) {
      situation_.time += kPeriod;
      stop = tracker_.compute({plan, situation_.pose, {}, shield_, kPeriod}, situation_).stop;
    }
    return stop;
  }

  PathTracker tracker_;
  Shield shield_;
  Situation situation_;
};

TEST_F(PathTrackerTest, GivesUpAfterThePatience) {
  EXPECT_EQ(follow(0.0, kPatience - 0.5), StopReason::kObstacle);
  EXPECT_EQ(follow(0.0, 1.0), StopReason::kStuck);
}

/// As of a program that asks twice at one time. It once took minutes, and all memory.
TEST_F(PathTrackerTest, StandsWhereItCannotBeAskedSoOften) {
  situation_.obstacles.clear();
  shield_.show({});
  const std::vector<Pose2> plan{{}, {3.0, 0.0, 0.0}};
  for (const double period : {0.0, -0.1, 1e-9, std::nan("")}) {
    const MotionCommand command = tracker_.compute({plan, {}, {}, shield_, period}, situation_);
    EXPECT_EQ(command.stop, StopReason::kUnusableData) << period;
    EXPECT_EQ(command.linear, 0.0) << period;
  }
  EXPECT_EQ(follow(0.0, kPeriod), StopReason::kNone);
}

TEST_F(PathTrackerTest, TriesAgainWhenThePlanLeadsAnotherWay) {
  ASSERT_EQ(follow(0.0, kPatience + 0.5), StopReason::kStuck);
  EXPECT_EQ(follow(0.9, kPeriod), StopReason::kStuck) << "less than 1 rad is not another way";
  EXPECT_NE(follow(1.1, kPeriod), StopReason::kStuck);
}

/// As by a pause that cancels the goal and sends it again, or by another heading where the robot has arrived.
TEST_F(PathTrackerTest, DoesNotCountThePauseBetweenTwoDrives) {
  situation_.obstacles.clear();
  shield_.show({});
  ASSERT_EQ(follow(0.0, kPeriod), StopReason::kNone) << "not held by anything";
  situation_.time += 2.0 * kPatience;
  EXPECT_EQ(follow(0.0, kPeriod), StopReason::kNone);
  EXPECT_EQ(follow(0.0, kPatience + 0.5), StopReason::kStuck);
}

TEST_F(PathTrackerTest, GivesUpAfterThePauseOfARecovery) {
  ASSERT_EQ(follow(0.0, kPatience + 0.5), StopReason::kStuck);
  situation_.time += kPatience;
  EXPECT_EQ(follow(0.0, kPeriod), StopReason::kStuck);
}

/// A Jackal in a corridor that is too narrow to turn in, and which ends 0.4 m ahead; the plan leads back. Half of its
/// patience passes before it plans, all of it may pass on the way. While it goes there it keeps half of the margin.
TEST(PathTracker, LeadsAWedgedRobotToWhereItCanTurn) {
  MotionParameters motion = test::limitsOfJackal();
  motion.patience = 15.0;
  PathTracker tracker(motion);
  Shield shield(test::jackal(), motion.safety_margin, 4.0);
  Situation situation;
  Twist2 twist;
  while (std::abs(normalizeAngle(situation.pose.yaw)) < 2.5) {
    situation.obstacles.clear();
    for (double x = -3.0; x <= 0.4; x += 0.02) {
      for (const double y : {0.29, -0.29}) situation.obstacles.push_back(toLocalFrame(situation.pose, {x, y}));
    }
    shield.show(situation.obstacles);
    const Point2 here{situation.pose.x, situation.pose.y};
    const std::vector<Pose2> plan = test::planAlong({here, {-3.0, 0.0}});
    twist = tracker.compute({plan, situation.pose, twist, shield, kPeriod}, situation);
    situation.pose = alongTurn(situation.pose, twist.linear * kPeriod, twist.angular * kPeriod);
    situation.time += kPeriod;
    ASSERT_LT(situation.time, 2.0 * motion.patience) << situation.pose.x << " " << situation.pose.yaw;
    ASSERT_GT(shield.gap({}), 0.5 * motion.safety_margin);
  }
}

/// At 20 Hz the first command of a robot that speeds up from what it measures is 0.03 m/s.
TEST(PathTracker, StartsABaseWhoseMotorsStandStillBelow8CentimetresASecond) {
  constexpr double kFast = 0.05;  // s
  for (const Footprint& footprint : {Footprint(0.174), test::waffle()}) {
    PathTracker tracker(MotionParameters{});
    const Shield shield(footprint, 0.03, 4.0);
    Situation situation;
    Twist2 twist;
    const std::vector<Pose2> plan = test::planAlong({{0.0, 0.0}, {3.0, 0.0}});
    for (; situation.time < 5.0; situation.time += kFast) {
      twist = tracker.compute({plan, situation.pose, twist, shield, kFast}, situation);
      if (twist.linear < 0.08) twist.linear = 0.0;
      situation.pose.x += twist.linear * kFast;
    }
    EXPECT_GT(situation.pose.x, 1.3) << "of the 1.5 m at full speed, less the start";
  }
}

struct WeakBase {
  const char* name;
  double share;  // of the commanded speed that it drives
  double lacks;  // m/s that it is slower
  double dead;   // m/s; it stands still at less
};

class PathTrackerOnAWeakBase : public testing::TestWithParam<WeakBase> {};

/// A tracker that speeds up from what it measures alone would command 0.03 m/s more than that at 20 Hz: it would get
/// 0.12 m/s of a base that drives 0.8 of what it is told, and 0.01 m/s of one that lacks 0.02 m/s. A base at full speed
/// would drive 10 s times share times max_linear = 0.3 m/s; 3 s of these are for the start and for noticing.
TEST_P(PathTrackerOnAWeakBase, GetsNearlyTheSpeedThatTheBaseHas) {
  constexpr double kFast = 0.05;  // s
  PathTracker tracker(MotionParameters{});
  const Shield shield(Footprint(0.174), 0.03, 4.0);
  Situation situation;
  Twist2 measured;
  const std::vector<Pose2> plan = test::planAlong({{0.0, 0.0}, {9.0, 0.0}});
  for (; situation.time < 10.0; situation.time += kFast) {
    const double told = tracker.compute({plan, situation.pose, measured, shield, kFast}, situation).linear;
    EXPECT_LE(told, MotionParameters().max_linear);
    measured.linear = told < GetParam().dead ? 0.0 : std::max(0.0, GetParam().share * told - GetParam().lacks);
    situation.pose.x += measured.linear * kFast;
  }
  const double full_speed = GetParam().share * MotionParameters().max_linear - GetParam().lacks;
  EXPECT_GT(situation.pose.x, 7.0 * full_speed);
}

INSTANTIATE_TEST_SUITE_P(PathTracker, PathTrackerOnAWeakBase,
                         testing::Values(WeakBase{"Scales", 0.8, 0.0, 0.0}, WeakBase{"ScalesMuch", 0.6, 0.0, 0.0},
                                         WeakBase{"IsSlower", 1.0, 0.05, 0.0}, WeakBase{"StartsLate", 1.0, 0.0, 0.2}),
                         [](const auto& info) { return info.param.name; });

TEST(Patience, BeginsAnewFourTimesWhileTheRobotGoesBack) {
  Patience patience;
  Situation situation;
  MotionCommand back;
  back.linear = -0.05;
  back.goes_back = true;
  while (patience.note(kPatience, back, {{}, {3.0, 0.0, 0.0}}, situation) != Patience::Left::kNone) {
    situation.time += kPeriod;
    ASSERT_LT(situation.time, 10.0 * kPatience) << "but not for ever";
  }
  EXPECT_NEAR(situation.time, (4 * 0.5 + 1.0) * kPatience, 1.0);
}

TEST(PathTracker, IsSlowerBeforeAnObstacleWhereTheOdometryIsLongOnItsWay) {
  const std::vector<Pose2> plan{{}, {3.0, 0.0, 0.0}};
  const auto speed = [&plan](double pose_age, double scan_age) {
    PathTracker tracker{MotionParameters()};
    Shield shield(Footprint(0.17), 0.03, 4.0);
    shield.show({{0.37, 0.0}});
    tracker.expectReactionTime(pose_age, scan_age, 0.05);
    return tracker.compute({plan, {}, {0.3, 0.0}, shield, 0.05}, {}).linear;
  };
  EXPECT_GT(speed(0.0, 0.0), 0.1);
  EXPECT_LT(speed(0.3, 0.3), speed(0.0, 0.0));
  EXPECT_DOUBLE_EQ(speed(0.0, 0.3), speed(0.0, 0.0)) << "it knows where it has come since the scan";
}

}  // namespace
}  // namespace lstm_planner::test_path_tracker
