// What the recorder makes of a drive: steps, labels, and the episodes they belong to.

#include "ros/fixtures/recorder_fixture.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::dataset_recorder_steps {
namespace {

using actionlib_msgs::GoalStatus;

TEST_F(RecorderTest, StepsAreLabelledWithThePathThatWasTaken) {
  start();
  giveGoal(goalAt(5.0, 0.0));
  drive({0.4, 0.0, 0.0}, 2.0);                                         // ahead
  drive({0.8, 0.4, 0.0}, 2.0);                                         // half left
  drive({0.8, 0.0, 0.0}, 2.0);                                         // right
  drive({0.8, 0.0, 2.0}, 1.0);                                         // turning left in place
  drive({0.8 - 0.2 * std::cos(2.0), -0.2 * std::sin(2.0), 2.0}, 1.0);  // backwards
  const Dataset dataset = finish();

  ASSERT_EQ(dataset.recordings.size(), 1U);
  const Recording& recording = dataset.recordings.front();
  EXPECT_TRUE(recording.finished);
  EXPECT_EQ(recording.description.odometry_frame, "odom");
  EXPECT_EQ(recording.description.source, "live");
  ASSERT_EQ(recording.episodes.size(), 1U);
  const RecordedEpisode& episode = recording.episodes.front();
  EXPECT_EQ(labelsOf(episode), (std::vector<int>{2, 2, 2, 2, 3, 3, 3, 3, 0, 0, 0, 0, 3, 3}));
  EXPECT_EQ(recording.rejections[static_cast<std::size_t>(Rejection::kNoAllowedAngle)], 2);
  EXPECT_EQ(recording.rejections[static_cast<std::size_t>(Rejection::kNoNextStep)], 1);
  EXPECT_EQ(episode.episode.end, EpisodeEnd::kFinished);

  const DriveStep& step = episode.steps.at(4);
  EXPECT_DOUBLE_EQ(step.next_stamp - step.stamp, 0.5);
  EXPECT_NEAR(step.pose.x, 0.4, 1e-9);
  EXPECT_NEAR(step.driven_angle, M_PI_4, 1e-9);
  EXPECT_NEAR(step.observation.goal_distance, 4.6, 1e-9);
  EXPECT_NEAR(step.observation.goal_bearing, 0.0, 1e-9);
  EXPECT_EQ(step.geometry.frame, "laser");
  EXPECT_NEAR(step.geometry.mount.pose.x, 0.1, 1e-9);
}

TEST_F(RecorderTest, GoalsAreHeardFromMoveBaseAndFromRviz) {
  start();
  giveGoal(goalAt(5.0, 0.0));
  drive({0.4, 0.0, 0.0}, 2.0);
  giveActionGoal(goalAt(5.0, 1.0), "a");
  drive({0.8, 0.0, 0.0}, 2.0);
  giveGoal(goalAt(2.0, -5.0, "map"));
  drive({1.2, 0.0, 0.0}, 2.0);
  const Dataset dataset = finish();

  const std::vector<RecordedEpisode>& episodes = dataset.recordings.at(0).episodes;
  ASSERT_EQ(episodes.size(), 3U);
  EXPECT_EQ(episodes[0].episode.goal_source, "move_base_simple/goal");
  EXPECT_EQ(episodes[0].episode.end, EpisodeEnd::kNewGoal);
  EXPECT_EQ(episodes[1].episode.goal_source, "move_base/goal");
  EXPECT_DOUBLE_EQ(episodes[1].episode.goal.pose.y, 1.0);
  // The odometry's origin is at (5, -2) of the map, turned by 90 degrees.
  EXPECT_EQ(episodes[2].episode.goal.frame, "map");
  ASSERT_FALSE(episodes[2].steps.empty());
  EXPECT_NEAR(episodes[2].steps.front().goal.x, -3.0, 1e-9);
  EXPECT_NEAR(episodes[2].steps.front().goal.y, 3.0, 1e-9);
}

TEST_F(RecorderTest, AGoalThatMoveBasePassesOnIsOneGoal) {
  start();
  const geometry_msgs::PoseStamped goal = goalAt(5.0, 0.0);
  giveGoal(goal);
  giveActionGoal(goal, "");
  drive({0.4, 0.0, 0.0}, 2.0);
  const Dataset dataset = finish();
  ASSERT_EQ(dataset.recordings.at(0).episodes.size(), 1U);
  EXPECT_EQ(dataset.recordings[0].episodes[0].steps.size(), 4U);
}

TEST_F(RecorderTest, ArrivalByOdometryEndsAnEpisode) {
  start();
  giveActionGoal(goalAt(1.0, 0.0), "a");
  drive({0.8, 0.0, 0.0}, 4.0);
  giveResult(GoalStatus::SUCCEEDED, "a");
  drive({2.0, 0.0, 0.0}, 6.0);
  EXPECT_EQ(count("episodes arrived"), 1);
  EXPECT_EQ(value("goal"), "none");
  const Dataset dataset = finish();
  ASSERT_EQ(dataset.recordings.at(0).episodes.size(), 1U);
  EXPECT_EQ(dataset.recordings[0].episodes[0].episode.end, EpisodeEnd::kArrived);
}

TEST_F(RecorderTest, SuccessOfTheActionAloneEndsNothing) {
  start();
  giveActionGoal(goalAt(5.0, 0.0), "a");
  drive({0.4, 0.0, 0.0}, 2.0);
  giveResult(GoalStatus::SUCCEEDED, "a");
  drive({0.8, 0.0, 0.0}, 2.0);
  const Dataset dataset = finish();
  ASSERT_EQ(dataset.recordings.at(0).episodes.size(), 1U);
  EXPECT_EQ(dataset.recordings[0].episodes[0].steps.size(), 8U);
}

TEST_F(RecorderTest, CancellingEndsAnEpisode) {
  start();
  giveActionGoal(goalAt(5.0, 0.0), "a");
  drive({0.4, 0.0, 0.0}, 2.0);
  giveCancel("of somebody else");
  drive({0.8, 0.0, 0.0}, 2.0);
  EXPECT_EQ(count("steps"), 7) << "the last is not labelled yet";
  giveCancel("a");
  drive({1.2, 0.0, 0.0}, 2.0);
  EXPECT_EQ(value("goal"), "none");
  const Dataset dataset = finish();
  ASSERT_EQ(dataset.recordings.at(0).episodes.size(), 1U);
  EXPECT_EQ(dataset.recordings[0].episodes[0].episode.end, EpisodeEnd::kAborted);
}

TEST_F(RecorderTest, AnAbortedGoalEndsItsEpisodeButNotThatOfTheNextGoal) {
  start();
  giveActionGoal(goalAt(5.0, 0.0), "a");
  drive({0.4, 0.0, 0.0}, 2.0);
  giveActionGoal(goalAt(5.0, 1.0), "b");
  giveResult(GoalStatus::PREEMPTED, "a");  // move_base says so after it has taken the new goal
  drive({0.8, 0.0, 0.0}, 2.0);
  giveResult(GoalStatus::ABORTED, "b");
  drive({1.2, 0.0, 0.0}, 2.0);
  const Dataset dataset = finish();
  const std::vector<RecordedEpisode>& episodes = dataset.recordings.at(0).episodes;
  ASSERT_EQ(episodes.size(), 2U);
  EXPECT_EQ(episodes[0].episode.end, EpisodeEnd::kNewGoal);
  EXPECT_EQ(episodes[1].episode.end, EpisodeEnd::kAborted);
  EXPECT_EQ(episodes[1].steps.size(), 3U) << "of four, the last look came after the end";
}

TEST_F(RecorderTest, JumpsOfOdometryAndClockEndAnEpisodeAndAGoalInTheMapStays) {
  start();
  giveGoal(goalAt(9.0, 0.0, "map"));
  drive({0.4, 0.0, 0.0}, 2.0);
  passTime(kTick);
  sense({3.0, 1.0, 0.0});
  drive({3.4, 1.0, 0.0}, 2.0);
  passTime(10.0);
  sense({3.4, 1.0, 0.0});
  drive({3.8, 1.0, 0.0}, 2.0);
  passTime(-60.0);
  sense({3.8, 1.0, 0.0});
  drive({4.2, 1.0, 0.0}, 2.0);
  const Dataset dataset = finish();
  std::vector<EpisodeEnd> ends;
  for (const RecordedEpisode& episode : dataset.recordings.at(0).episodes) {
    ends.push_back(episode.episode.end);
    EXPECT_GE(episode.steps.size(), 3U);
    for (const DriveStep& step : episode.steps) EXPECT_EQ(step.label, 2) << "no step goes across a jump";
  }
  EXPECT_EQ(ends, (std::vector<EpisodeEnd>{EpisodeEnd::kOdometryJump, EpisodeEnd::kTimeJump, EpisodeEnd::kTimeJump,
                                           EpisodeEnd::kFinished}));
}

TEST_F(RecorderTest, NothingIsRecordedWhilePaused) {
  start();
  giveGoal(goalAt(5.0, 0.0));
  drive({0.4, 0.0, 0.0}, 2.0);
  EXPECT_EQ(pause(true), "paused with 3 steps");
  drive({0.8, 0.0, 0.0}, 2.0);
  EXPECT_EQ(value("paused"), "yes");
  EXPECT_EQ(value("message"), "paused");
  pause(false);
  drive({1.2, 0.0, 0.0}, 2.0);
  const Dataset dataset = finish();
  const std::vector<RecordedEpisode>& episodes = dataset.recordings.at(0).episodes;
  ASSERT_EQ(episodes.size(), 2U);
  EXPECT_EQ(episodes[0].episode.end, EpisodeEnd::kPaused);
  EXPECT_GE(episodes[1].steps.front().pose.x, 0.7);
  EXPECT_GT(dataset.recordings[0].rejections[static_cast<std::size_t>(Rejection::kPaused)], 0);
}

TEST_F(RecorderTest, TheRunningEpisodeOrElseTheLastOneIsDiscarded) {
  start();
  EXPECT_FALSE(trigger("discard_episode").success) << "there is none";
  giveGoal(goalAt(5.0, 0.0));
  drive({0.4, 0.0, 0.0}, 2.0);
  EXPECT_TRUE(trigger("discard_episode").success);
  EXPECT_FALSE(trigger("discard_episode").success) << "it is discarded already";
  EXPECT_EQ(count("steps"), 0);
  drive({0.8, 0.0, 0.0}, 2.0);
  giveCancel("");
  drive({1.2, 0.0, 0.0}, 2.0);
  EXPECT_TRUE(trigger("discard_episode").success) << "the last one";
  giveGoal(goalAt(6.0, 0.0));
  drive({1.6, 0.0, 0.0}, 2.0);
  const Dataset dataset = finish();
  const std::vector<RecordedEpisode>& episodes = dataset.recordings.at(0).episodes;
  ASSERT_EQ(episodes.size(), 3U);
  EXPECT_TRUE(episodes[0].episode.discarded);
  EXPECT_TRUE(episodes[1].episode.discarded);
  EXPECT_DOUBLE_EQ(episodes[1].episode.goal.pose.x, 5.0) << "the goal stayed the goal";
  EXPECT_FALSE(episodes[2].episode.discarded);
  EXPECT_EQ(stepCount(dataset), static_cast<long>(episodes[2].steps.size()));
}

TEST_F(RecorderTest, AGoalThatWasJustGivenStaysTheGoalWhereAnEpisodeIsDiscarded) {
  start();
  giveGoal(goalAt(5.0, 0.0));
  drive({0.8, 0.0, 0.0}, 4.0);
  giveGoal(goalAt(6.0, 0.0));
  EXPECT_TRUE(trigger("discard_episode").success);
  drive({1.6, 0.0, 0.0}, 4.0);
  giveCancel("");
  EXPECT_TRUE(trigger("discard_episode").success);
  drive({2.4, 0.0, 0.0}, 4.0);
  const Dataset dataset = finish();
  std::vector<double> goals;
  for (const RecordedEpisode& episode : dataset.recordings.at(0).episodes) {
    if (!episode.steps.empty()) goals.push_back(episode.episode.goal.pose.x);
  }
  EXPECT_EQ(goals, (std::vector<double>{5.0, 6.0})) << "and cancelled, in the end";
}

TEST_F(RecorderTest, WhatIsNotFiniteIsCountedAndNotRecorded) {
  start();
  giveGoal(goalAt(5.0, 0.0));
  drive({0.2, 0.0, 0.0}, 1.0);
  passTime(kTick);
  sense({NAN, 0.0, 0.0});
  giveGoal(goalAt(NAN, 0.0));
  passTime(kTick);
  sense({0.2, 0.0, 0.0});
  stand(1.0);
  EXPECT_GE(count("rejected: not finite"), 2);
  EXPECT_EQ(value("goal"), "(5.00, 0.00) in odom");
  const Dataset dataset = finish();
  EXPECT_EQ(dataset.recordings.at(0).episodes.size(), 1U);
}

const RosProgram program("dataset_recorder_steps", &runTests);

}  // namespace
}  // namespace lstm_planner::dataset_recorder_steps
