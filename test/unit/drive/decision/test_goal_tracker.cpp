#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "lstm_planner/drive/decision/goal_changes.hpp"
#include "lstm_planner/drive/decision/goal_tracker.hpp"
#include "lstm_planner/drive/decision/navigation_agent.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_goal_tracker {
namespace {

using Verdict = GoalTracker::Verdict;

constexpr double kPatience = 1.0;
const GoalInFrame kGoal{"odom", {3.0, 1.0, 0.5}};
const GoalInFrame kOtherGoal{"odom", {-2.0, 4.0, 0.0}};

/// kGoal, but at this x.
GoalInFrame at(double x) { return {"odom", {x, 1.0, 0.5}}; }

TEST(GoalTrackerTest, AnnouncedGoalIsNewOnceAndDrivenAfterwards) {
  GoalTracker tracker(kPatience);
  tracker.announce(kGoal);
  EXPECT_EQ(tracker.ask(kGoal, 0.0), Verdict::kNewGoal);
  EXPECT_EQ(tracker.ask(kGoal, 0.2), Verdict::kDriven);
  EXPECT_EQ(tracker.ask(kGoal, 100.0), Verdict::kDriven);
}

TEST(GoalTrackerTest, AnAnnouncedGoalThatWasGivenUpIsNewWhenItIsAnnouncedAgain) {
  GoalTracker tracker(kPatience);
  tracker.announce(kGoal);
  tracker.ask(kGoal, 0.0);
  tracker.setGivenUp(true);
  EXPECT_EQ(tracker.ask(kGoal, 0.2), Verdict::kDriven) << "move_base goes on asking until its own patience ends";
  EXPECT_EQ(tracker.ask(kGoal, 6.5), Verdict::kDriven) << "it asks for no plan while the robot turns to recover";
  tracker.announce(kGoal);
  EXPECT_EQ(tracker.ask(kGoal, 100.0), Verdict::kNewGoal);
}

TEST(GoalTrackerTest, WhereNothingIsAnnouncedAGoalThatWasGivenUpIsNewAfterAPause) {
  GoalTracker tracker(kPatience);
  tracker.ask(kGoal, 0.0);
  tracker.ask(kGoal, 0.2);
  tracker.setGivenUp(true);
  EXPECT_EQ(tracker.ask(kGoal, 0.4), Verdict::kDriven);
  EXPECT_EQ(tracker.ask(kGoal, 100.0), Verdict::kNewGoal);
  tracker.setGivenUp(false);
  EXPECT_EQ(tracker.ask(kGoal, 200.0), Verdict::kDriven);
}

TEST(GoalTrackerTest, AnnouncingTheSamePoseAgainStartsAnew) {
  GoalTracker tracker(kPatience);
  tracker.announce(kGoal);
  tracker.ask(kGoal, 0.0);
  tracker.announce(kGoal);
  EXPECT_EQ(tracker.ask(kGoal, 0.2), Verdict::kNewGoal);
  EXPECT_EQ(tracker.ask(kGoal, 0.4), Verdict::kDriven);
}

TEST(GoalTrackerTest, QuestionsBesideADrivenGoalStayQuestionsHoweverOften) {
  GoalTracker tracker(kPatience);
  tracker.announce(kGoal);
  tracker.ask(kGoal, 0.0);
  for (int i = 1; i < 100; ++i) {
    const double time = 0.2 * i;
    EXPECT_EQ(tracker.ask(kOtherGoal, time - 0.15), Verdict::kQuestion);
    EXPECT_EQ(tracker.ask(kOtherGoal, time - 0.10), Verdict::kQuestion);
    EXPECT_EQ(tracker.ask(kGoal, time), Verdict::kDriven);
  }
}

TEST(GoalTrackerTest, NeighbouringGoalsNeverTakeOver) {
  GoalTracker tracker(kPatience);
  tracker.announce(kGoal);
  tracker.ask(kGoal, 0.0);
  for (int i = 0; i < 1000; ++i) {
    const GoalInFrame neighbour{"odom", {5.0 + 0.15 * i, 1.0, 0.5}};
    EXPECT_EQ(tracker.ask(neighbour, 0.1 * i), Verdict::kQuestion);
  }
  EXPECT_EQ(tracker.ask(kGoal, 101.0), Verdict::kDriven);
}

TEST(GoalTrackerTest, WithoutAnyGoalTheSecondQuestionAdopts) {
  GoalTracker tracker(kPatience);
  EXPECT_EQ(tracker.ask(kGoal, 0.0), Verdict::kQuestion);
  EXPECT_EQ(tracker.ask(kGoal, 0.0), Verdict::kNewGoal);
  EXPECT_EQ(tracker.ask(kGoal, 0.2), Verdict::kDriven);
}

TEST(GoalTrackerTest, WhereGoalsAreAnnouncedAQuestionStaysOneHoweverOftenItIsAsked) {
  GoalTracker tracker(kPatience);
  tracker.announce(kGoal);
  tracker.ask(kGoal, 0.0);
  for (const double time : {10.0, 11.1, 12.2}) EXPECT_EQ(tracker.ask(kOtherGoal, time), Verdict::kQuestion) << time;
}

TEST(GoalTrackerTest, UnannouncedGoalTakesOverWhenTheOldOneIsNoLongerAskedFor) {
  GoalTracker tracker(kPatience);
  tracker.ask(kGoal, -0.2);
  tracker.ask(kGoal, 0.0);
  EXPECT_EQ(tracker.ask(kOtherGoal, 0.2), Verdict::kQuestion);
  EXPECT_EQ(tracker.ask(kOtherGoal, 0.7), Verdict::kQuestion);
  EXPECT_EQ(tracker.ask(kOtherGoal, 1.2), Verdict::kNewGoal) << "the first question is 1.0 s old";
  EXPECT_EQ(tracker.ask(kOtherGoal, 1.4), Verdict::kDriven);
  EXPECT_EQ(tracker.ask(kGoal, 1.5), Verdict::kQuestion);
}

TEST(GoalTrackerTest, LateAnnouncementOfAnAdoptedGoalStartsItAnew) {
  GoalTracker tracker(kPatience);
  tracker.ask(kGoal, 0.0);
  tracker.ask(kGoal, 0.2);
  tracker.announce(kGoal);
  EXPECT_EQ(tracker.ask(kGoal, 0.4), Verdict::kNewGoal);
}

TEST(GoalTrackerTest, LastCallForTheReplacedGoalIsAQuestion) {
  GoalTracker tracker(kPatience);
  tracker.announce(kGoal);
  tracker.ask(kGoal, 0.0);
  tracker.announce(kOtherGoal);
  EXPECT_EQ(tracker.ask(kGoal, 0.1), Verdict::kQuestion);
  EXPECT_EQ(tracker.ask(kOtherGoal, 0.2), Verdict::kNewGoal);
}

TEST(GoalTrackerTest, ClockThatJumpsBackDoesNotBlockATakeover) {
  GoalTracker tracker(kPatience);
  tracker.ask(kGoal, 999.8);
  tracker.ask(kGoal, 1000.0);
  tracker.ask(kOtherGoal, 1000.2);
  EXPECT_EQ(tracker.ask(kOtherGoal, 0.0), Verdict::kQuestion);
  EXPECT_EQ(tracker.ask(kOtherGoal, 1.0), Verdict::kNewGoal);
}

TEST(GoalTrackerTest, GoalThatIsAnnouncedBeforeEachPlanIsNewOnce) {
  const GoalInFrame plan_end{"map", {2.9, 1.0, 0.5}};
  GoalTracker tracker(kPatience, true);
  for (int i = 0; i < 20; ++i) {
    tracker.announce(kGoal);
    EXPECT_EQ(tracker.ask(kGoal, 0.2 * i), i == 0 ? Verdict::kNewGoal : Verdict::kDriven);
    tracker.announce(plan_end);
    EXPECT_EQ(tracker.ask(kGoal, 0.2 * i + 0.1), Verdict::kDriven) << "asked again without an announcement";
  }
  tracker.announce(kOtherGoal);
  EXPECT_EQ(tracker.ask(kOtherGoal, 4.0), Verdict::kNewGoal);
  tracker.announce(kOtherGoal);
  EXPECT_EQ(tracker.ask(kOtherGoal, 10.0), Verdict::kNewGoal) << "sent again, after it had ended";
}

TEST(GoalTrackerTest, AGoalThatIsGivenAnewNearByIsTheSameUntilItsDriveHasEnded) {
  GoalTracker tracker(kPatience);
  tracker.setDrive(1);
  tracker.announce(kGoal);
  tracker.announce(at(3.02));
  EXPECT_EQ(tracker.ask(at(3.02), 0.0), Verdict::kNewGoal);
  tracker.announce(kGoal);
  EXPECT_EQ(tracker.ask(at(3.02), 0.1), Verdict::kQuestion);
  EXPECT_EQ(tracker.ask(kGoal, 0.2), Verdict::kMoved);
  EXPECT_EQ(tracker.ask(kGoal, 0.4), Verdict::kDriven);
  tracker.announce(kGoal);
  EXPECT_EQ(tracker.ask(kGoal, 10.0), Verdict::kDriven);
  tracker.setDrive({});
  tracker.setDrive(2);
  tracker.announce(kGoal);
  EXPECT_EQ(tracker.ask(kGoal, 11.0), Verdict::kNewGoal);
}

TEST(GoalTrackerTest, AGoalThatGoesAwayByCentimetresIsNewAgainAndAgain) {
  GoalTracker tracker(kPatience);
  tracker.setDrive(1);
  int new_goals = 0;
  for (int i = 0; i < 100; ++i) {
    tracker.announce(at(3.0 + 0.02 * i));
    new_goals += tracker.ask(at(3.0 + 0.02 * i), 0.2 * i) == Verdict::kNewGoal ? 1 : 0;
  }
  EXPECT_EQ(new_goals, 8) << "2 m; the 13th goal is 0.26 m from the first";
}

TEST(GoalTrackerTest, WhereEachPlanIsAnnouncedAPauseOfADriveThatGoesOnMakesNoNewGoal) {
  GoalTracker tracker(kPatience, true);
  const auto ask = [&](const GoalInFrame& goal, double time) {
    tracker.announce(goal);
    return tracker.ask(goal, time);
  };
  tracker.setDrive(1);
  EXPECT_EQ(ask(kGoal, 0.0), Verdict::kNewGoal);
  tracker.setGivenUp(true);
  EXPECT_EQ(ask(kGoal, 6.5), Verdict::kDriven) << "a recovery behaviour took that long";
  EXPECT_EQ(ask(at(3.02), 6.7), Verdict::kMoved);
  tracker.setDrive(2);
  EXPECT_EQ(ask(at(3.02), 20.0), Verdict::kNewGoal);
}

/// As exploration gives it, which never leaves a planner the time to look around three times.
TEST(GoalTrackerTest, AGoalInAClosedRoomThatIsGivenAnewEveryThreeSecondsIsGivenUp) {
  constexpr double kPeriod = 0.2;    // s
  constexpr double kTurnRate = 1.5;  // rad/s
  GoalTracker tracker(kPatience);
  tracker.setDrive(1);
  NavigationAgent agent(test::straightAheadPolicy(), test::routeLed());
  GoalChanges changes;
  GoalInFrame goal = kGoal;
  int i = 0;
  for (; i * kPeriod < 60.0; ++i) {
    const double time = i * kPeriod;
    if (i % 15 == 0) tracker.announce(goal = at(i % 30 == 0 ? 3.0 : 3.02));
    agent.perceive(test::situationAt({0.0, 0.0, normalizeAngle(kTurnRate * time)}, time, test::ring(0.8)));
    changes.tell(&agent, goal.pose, {}, tracker.ask(goal, time) == Verdict::kNewGoal, 0);
    tracker.setGivenUp(agent.decide().choice == Decision::Move::kNoPath);
    if (agent.decision().choice == Decision::Move::kNoPath) break;
  }
  EXPECT_LT(i * kPeriod, 20.0) << "s; three turns take 13";
}

TEST(GoalTrackerTest, GoalsDifferByFramePositionAndHeading) {
  EXPECT_TRUE(sameGoal(kGoal, {"odom", {3.0005, 1.0, 0.5 + 2.0 * M_PI}}));
  EXPECT_FALSE(sameGoal(kGoal, {"map", {3.0, 1.0, 0.5}}));
  EXPECT_FALSE(sameGoal(kGoal, {"odom", {3.01, 1.0, 0.5}}));
  EXPECT_FALSE(sameGoal(kGoal, {"odom", {3.0, 1.0, 0.6}}));
}

TEST(GoalTrackerTest, RefusesAPatienceThatNeverEnds) {
  EXPECT_THROW(GoalTracker(0.0), std::invalid_argument);
  EXPECT_THROW(GoalTracker(std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_goal_tracker
