#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "lstm_planner/drive/decision/goal_tracker.hpp"

namespace lstm_planner::test_goal_tracker {
namespace {

using Verdict = GoalTracker::Verdict;

constexpr double kPatience = 1.0;
const GoalInFrame kGoal{"odom", {3.0, 1.0, 0.5}};
const GoalInFrame kOtherGoal{"odom", {-2.0, 4.0, 0.0}};

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
