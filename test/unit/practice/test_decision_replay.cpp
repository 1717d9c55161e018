#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "lstm_planner/practice/decision_replay.hpp"
#include "unit/drive/decision/agent_fixtures.hpp"

namespace lstm_planner::test_decision_replay {
namespace {

constexpr double kStepLength = 0.2;  // m, driven in a step
constexpr double kPeriod = 0.5;      // s

/// Prefers the left, then straight on; the driver of these tests goes straight on.
DecisionReplay leftwards() {
  AgentParameters parameters;
  parameters.memory.enabled = false;  // in a closed hall no path would lead to the goals
  return DecisionReplay(test::policyPreferring({0.1f, 0.2f, 0.3f, 0.9f, 0.4f}), parameters, {});
}

/// The n-th step of a drive straight along x, in a hall whose walls are 5 m away.
DriveStep step(int n) {
  DriveStep step;
  step.number = n;
  step.stamp = 100.0 + kPeriod * n;
  step.next_stamp = step.stamp + kPeriod;
  step.pose = {kStepLength * n, 0.0, 0.0};
  step.next_pose = {kStepLength * (n + 1), 0.0, 0.0};
  step.goal = {20.0, 0.0};
  step.geometry = {"laser", -M_PI, M_PI / 180.0, 361, 0.02, 30.0, {}};
  step.ranges.assign(361, 5.0f);
  return step;
}

Episode episodeTo(double x) {
  Episode episode;
  episode.goal = {"odom", {x, 0.0, 0.0}};
  return episode;
}

void drive(int from, int to, DecisionReplay* replay) {
  for (int n = from; n < to; ++n) replay->addStep(step(n));
}

std::string asText(const DecisionReplay& replay) {
  std::ostringstream text;
  writeDecisions(replay.decisions(), &text);
  return text.str();
}

TEST(DecisionReplayTest, TellsWhatPlannerAndDriverDidAtEachStep) {
  DecisionReplay replay = leftwards();
  replay.startEpisode(episodeTo(20.0));
  drive(0, 3, &replay);
  ASSERT_EQ(replay.decisions().size(), 3u);
  const ReplayedDecision& second = replay.decisions()[1];
  EXPECT_EQ(second.stamp, step(1).stamp);
  EXPECT_EQ(second.next_pose.x, step(1).next_pose.x);
  EXPECT_EQ(second.decision.choice, Leader::kNetwork);
  EXPECT_EQ(second.decision.preferences.size(), 5u);
  EXPECT_EQ(second.action, 3);
  EXPECT_NEAR(second.steering_angle, M_PI / 4.0, 1e-6);
  EXPECT_EQ(second.driven_action, 2);
  EXPECT_EQ(second.driven_angle, 0.0);
}

TEST(DecisionReplayTest, AdvisesWhenAStepBeginsAndTellsWhatWasDrivenAfterwards) {
  DecisionReplay replay = leftwards();
  replay.startEpisode(episodeTo(20.0));
  for (int n = 0; n < 10; ++n) {
    replay.advise(step(n));
    ASSERT_TRUE(replay.advice());
    EXPECT_EQ(replay.advice()->action, 3);
    EXPECT_EQ(replay.decisions().size(), static_cast<std::size_t>(n));
    replay.addStep(step(n));
    EXPECT_FALSE(replay.advice());
  }
  DecisionReplay afterwards = leftwards();
  afterwards.startEpisode(episodeTo(20.0));
  drive(0, 10, &afterwards);
  EXPECT_EQ(asText(replay), asText(afterwards)) << "it was asked twice about a step";
}

TEST(DecisionReplayTest, AStepWhoseLabelDoesNotBecomeKnownIsNotCounted) {
  DecisionReplay replay = leftwards();
  replay.startEpisode(episodeTo(20.0));
  replay.advise(step(0));
  replay.reject(Rejection::kNoAllowedAngle);
  replay.advise(step(1));
  replay.addStep(step(1));
  ASSERT_EQ(replay.decisions().size(), 1u);
  EXPECT_EQ(replay.decisions()[0].stamp, step(1).stamp);
}

TEST(DecisionReplayTest, TheSameStepsGiveTheSameDecisionsWhateverElseIsReplayedBefore) {
  DecisionReplay once = leftwards();
  once.startEpisode(episodeTo(20.0));
  drive(0, 10, &once);
  DecisionReplay again = leftwards();
  again.startEpisode(episodeTo(20.0));
  again.reject(Rejection::kStanding);
  drive(0, 10, &again);
  EXPECT_EQ(asText(once), asText(again));
}

TEST(DecisionReplayTest, CountsHowOftenPlannerAndDriverAgree) {
  DecisionReplay replay = leftwards();
  replay.startEpisode(episodeTo(20.0));
  drive(0, 3, &replay);
  DriveStep to_the_left = step(3);
  to_the_left.driven_angle = M_PI / 4.0 + 0.1;
  replay.addStep(to_the_left);
  const Agreement agreement = agreementOf(replay.decisions());
  EXPECT_EQ(agreement.decisions, 4);
  EXPECT_EQ(agreement.same_action, 1);
  EXPECT_NEAR(agreement.mean_difference, (3.0 * M_PI / 4.0 + 0.1) / 4.0, 1e-6);
  EXPECT_EQ(agreement.balanced, (0.0 + 1.0) / 2.0) << "none of the steps straight on, the one to the left";
  EXPECT_EQ(agreement.majority, 3.0 / 4.0);
  EXPECT_EQ(agreement.majority_balanced, 1.0 / 2.0);
  EXPECT_EQ(agreement.asked, 4);
  EXPECT_EQ(agreement.preferred, 1);
  EXPECT_EQ(
      describeReplay(replay),
      "4 decisions in 1 episode (network 4): the planner took the driver's steering angle at 1 (25 %, balanced 50 %; "
      "majority-class baseline: 75 %, balanced 50 %), their angles differ by 35 degrees on average; "
      "the network preferred it at 1 of 4");
  EXPECT_EQ(agreementOf({}).decisions, 0);
  EXPECT_EQ(agreementOf({}).mean_difference, 0.0);
}

/// Decision::step counts since the agent was given its goal.
TEST(DecisionReplayTest, ANewEpisodeIsANewGoal) {
  DecisionReplay replay = leftwards();
  replay.startEpisode(episodeTo(20.0));
  drive(0, 4, &replay);
  const long steps = replay.decisions().back().decision.step;
  replay.endEpisode(102.0, EpisodeEnd::kArrived);
  replay.startEpisode(episodeTo(20.0));
  drive(4, 5, &replay);
  EXPECT_EQ(steps, replay.decisions().front().decision.step + 3);
  EXPECT_EQ(replay.decisions().back().decision.step, replay.decisions().front().decision.step);
  EXPECT_EQ(replay.decisions().back().episode, 1);
}

TEST(DecisionReplayTest, AGapInTimeIsNoNewGoal) {
  DecisionReplay replay = leftwards();
  replay.startEpisode(episodeTo(20.0));
  drive(0, 4, &replay);
  replay.endEpisode(102.0, EpisodeEnd::kTimeJump);
  replay.startEpisode(episodeTo(20.0));
  drive(4, 5, &replay);
  EXPECT_EQ(replay.decisions().back().decision.step, replay.decisions().front().decision.step + 4);
}

TEST(DecisionReplayTest, AfterAJumpOfOdometryOrClockTheAgentStartsAnew) {
  for (const EpisodeEnd end : {EpisodeEnd::kOdometryJump, EpisodeEnd::kTimeJump}) {
    DecisionReplay replay = leftwards();
    replay.startEpisode(episodeTo(20.0));
    drive(0, 4, &replay);
    replay.endEpisode(102.0, end);
    replay.startEpisode(episodeTo(20.0));
    DriveStep after = step(4);
    if (end == EpisodeEnd::kTimeJump) after.stamp = 50.0;  // the clock was set back
    replay.addStep(after);
    EXPECT_EQ(replay.decisions().back().decision.step, replay.decisions().front().decision.step) << toString(end);
  }
}

TEST(DecisionReplayTest, StepsWithoutScansAreRefused) {
  DecisionReplay replay = leftwards();
  replay.startEpisode(episodeTo(20.0));
  DriveStep blind = step(0);
  blind.ranges.clear();
  EXPECT_THROW(replay.addStep(blind), std::invalid_argument);
}

TEST(DecisionReplayTest, AScannerThatIsTooShortForTheModelIsLedByTheRoute) {
  DecisionReplay replay(test::straightAheadPolicy(), {}, {});
  replay.startEpisode(episodeTo(20.0));
  DriveStep short_sighted = step(0);
  short_sighted.geometry.range_max = 1.0;  // less than half the model's range cap
  short_sighted.ranges.assign(361, 0.9f);
  replay.addStep(short_sighted);
  EXPECT_EQ(replay.decisions().back().decision.leader, Leader::kRoute);
}

TEST(DecisionReplayTest, WritesARowADecision) {
  DecisionReplay replay = leftwards();
  replay.startEpisode(episodeTo(20.0));
  drive(0, 1, &replay);
  EXPECT_EQ(asText(replay),
            "episode,stamp,source,overruled,action,steering_angle,driven_action,driven_angle,preferences\n"
            "0,100.000000,network,no,3,0.7854,2,0.0000,0.1000 0.2000 0.3000 0.9000 0.4000\n");
}

TEST(DecisionReplayTest, CutsADriveIntoStepsWithTheModelsAnglesAndScans) {
  PolicyDescription description;
  description.actions = ActionSet({-1.0, 0.0, 1.0});
  description.encoder.range_cap = 4.0;
  const RecorderParameters parameters = replayParameters(description, {}, {});
  EXPECT_NO_THROW(validate(parameters));
  EXPECT_EQ(parameters.action_angles, description.actions.angles());
  EXPECT_EQ(parameters.range_cap, 4.0);
  EXPECT_TRUE(parameters.keep_scans);
  EXPECT_EQ(parameters.period, AgentParameters().step.period);
}

}  // namespace
}  // namespace lstm_planner::test_decision_replay
