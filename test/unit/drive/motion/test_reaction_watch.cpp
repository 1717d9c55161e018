#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <functional>

#include "lstm_planner/drive/motion/path_tracker.hpp"
#include "lstm_planner/drive/motion/reaction_watch.hpp"
#include "lstm_planner/simulation/create2.hpp"
#include "unit/drive/motion/plan_along.hpp"

namespace lstm_planner::test_reaction_watch {
namespace {

constexpr double kPeriod = 0.05;    // s
constexpr double kExpected = 0.25;  // s

/// What is found in 30 s of turns to and fro, 4 s each, by what is measured so long (s) after the first command.
double delayFound(const std::function<double(double time)>& measured) {
  ReactionWatch watch;
  for (int i = 0; i < 600; ++i) {
    const double time = i * kPeriod;
    watch.note(measured(time), std::sin(0.5 * M_PI * time), kPeriod, kExpected);
  }
  return watch.delay();
}

double commandedBefore(double time, double delay) { return std::sin(0.5 * M_PI * (time - delay)); }

TEST(ReactionWatch, MeasuresADelayThatIsLongerThanExpected) {
  for (const double delay : {0.7, 1.0, 1.5}) {
    EXPECT_NEAR(delayFound([&](double time) { return commandedBefore(time, delay); }), delay, 0.5 * kPeriod);
    EXPECT_NEAR(delayFound([&](double time) { return 0.7 * commandedBefore(time, delay); }), delay, 0.5 * kPeriod)
        << "the wheels slip";
  }
}

TEST(ReactionWatch, MeasuresADelayWhereThePeriodIsMeasuredToo) {
  ReactionWatch watch;
  for (int i = 0; i < 600; ++i) {
    const double time = i * kPeriod;
    watch.note(commandedBefore(time, 0.7), commandedBefore(time, 0.0), kPeriod * (1.0 + 0.02 * (i % 3)), kExpected);
  }
  EXPECT_NEAR(watch.delay(), 0.7, 0.1);
}

TEST(ReactionWatch, FindsNothingWhereTheBaseIsAsFastAsExpected) {
  for (const double delay : {0.0, 0.1, kExpected}) {
    EXPECT_EQ(delayFound([&](double time) { return commandedBefore(time, delay); }), 0.0) << delay;
  }
}

TEST(ReactionWatch, FindsNothingWhereTheRobotDoesNotFollowTheCommands) {
  EXPECT_EQ(delayFound([](double) { return 0.0; }), 0.0) << "it is held";
  EXPECT_EQ(delayFound([](double time) { return 0.02 * commandedBefore(time, 0.7); }), 0.0) << "no more than noise";
  EXPECT_EQ(delayFound([](double time) { return std::sin(1.3 * time); }), 0.0) << "somebody else drives it";
}

TEST(ReactionWatch, FindsNothingInALongEvenTurn) {
  ReactionWatch watch;
  for (int i = 0; i < 600; ++i) watch.note(i < 14 ? 0.0 : 0.5, 0.5, kPeriod, kExpected);
  EXPECT_EQ(watch.delay(), 0.0);
}

TEST(ReactionWatch, ATrackerThatWasNotToldOfASmootherTurnsToItsPlanNevertheless) {
  PathTracker tracker({});
  Shield shield(Footprint(0.17), 0.03, 4.0);
  shield.show({});
  Situation situation;
  const std::vector<Pose2> plan = test::planAlong({{0.0, 0.0}, {0.0, 3.0}});
  Create2 robot({}, {}, 1);
  std::deque<Twist2> on_their_way(18);  // 0.9 s
  while (!tracker.goalReached(robot.odometry(), plan.back())) {
    situation.time += kPeriod;
    ASSERT_LT(situation.time, 60.0) << "it turns to and fro";
    situation.pose = robot.odometry();
    tracker.expectReactionTime(0.1, 0.1, kPeriod);
    on_their_way.push_back(tracker.compute({plan, situation.pose, robot.measuredTwist(), shield, kPeriod}, situation));
    robot.command(on_their_way.front());
    on_their_way.pop_front();
    robot.step(kPeriod);
  }
  EXPECT_NEAR(tracker.delayOfBase(), 0.95, 0.06) << "and a period until the odometry shows it";
}

}  // namespace
}  // namespace lstm_planner::test_reaction_watch
