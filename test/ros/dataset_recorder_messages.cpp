// What messages tell a DriveRecorder: without the node, since bags are read through the same.

#include <actionlib_msgs/GoalStatus.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <tf2/buffer_core.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lstm_planner/ros/common/conversions.hpp"
#include "lstm_planner/ros/recorder/drive_messages.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::dataset_recorder_messages {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class ListSink : public StepSink {
 public:
  void startEpisode(const Episode& episode) override { episodes.push_back({episode, {}}); }
  void addStep(const DriveStep& step) override { episodes.back().steps.push_back(step); }
  void endEpisode(double, EpisodeEnd end) override { episodes.back().episode.end = end; }
  void reject(Rejection rejection) override { ++rejections[static_cast<std::size_t>(rejection)]; }
  void explain(Rejection, const std::string& why) override { reason = why; }
  long count(Rejection rejection) const { return rejections[static_cast<std::size_t>(rejection)]; }

  struct Recorded {
    Episode episode;
    std::vector<DriveStep> steps;
  };
  std::vector<Recorded> episodes;
  RejectionCounts rejections{};
  std::string reason;  ///< of the last rejection
};

class DriveMessagesTest : public testing::Test {
 protected:
  DriveMessagesTest() { setTransform("base_footprint", "laser", {0.1, 0.0, 0.0}); }

  void setTransform(const std::string& parent, const std::string& child, const Pose2& pose) {
    tf_.setTransform(toMessage(pose, parent, child), "test", true);
  }

  nav_msgs::Odometry odometry() const {
    nav_msgs::Odometry message;
    message.header.stamp = now_;
    message.header.frame_id = "/odom";
    message.child_frame_id = "base_footprint";
    message.pose.pose = toMessage({x_, 0.0, 0.0});
    return message;
  }

  sensor_msgs::LaserScan scan() const {
    sensor_msgs::LaserScan message;
    message.header.stamp = now_;
    message.header.frame_id = "laser";
    message.angle_min = static_cast<float>(-0.75 * M_PI);
    message.angle_increment = static_cast<float>(M_PI / 180.0);
    message.range_min = 0.02F;
    message.range_max = 30.0F;
    message.ranges.assign(271, 4.0F);
    return message;
  }

  geometry_msgs::PoseStamped goal(double x, const std::string& frame = "odom") const {
    return toMessage({x, 0.0, 0.0}, frame, now_);
  }

  /// As rviz gives it, and as move_base passes it on to its action, which then makes an id.
  void giveGoalOfRviz(double x) {
    messages_.hearGoal(goal(x), "rviz", now_);
    move_base_msgs::MoveBaseActionGoal passed_on;
    passed_on.header.stamp = now_;
    passed_on.goal.target_pose = goal(x);
    messages_.hear(passed_on, "move_base", now_);
  }

  /// `made`: when the action made the id of the goal that ended.
  void giveEnd(int status, const ros::Time& made) {
    move_base_msgs::MoveBaseActionResult result;
    result.header.stamp = now_;
    result.status.status = static_cast<decltype(result.status.status)>(status);
    result.status.goal_id.id = "/move_base-1-" + std::to_string(made.toSec());
    result.status.goal_id.stamp = made;
    messages_.hear(result, now_);
  }

  /// At 0.2 m/s, ten times a second.
  void drive(double seconds) {
    for (int i = 0; i < std::lround(10.0 * seconds); ++i) {
      now_ += ros::Duration(0.1);
      x_ += 0.02;
      messages_.hear(odometry(), now_);
      messages_.hear(scan(), now_);
    }
  }

  tf2::BufferCore tf_;
  ListSink sink_;
  DriveMessages messages_{tf_, "base_link", std::nullopt, RecorderParameters(), &sink_};
  ros::Time now_{100.0};
  double x_ = 0.0;
};

TEST_F(DriveMessagesTest, AScannerThatIsNowhereIsSaidAndFoundLater) {
  nav_msgs::Odometry message = odometry();
  message.child_frame_id = "another_base";
  messages_.hear(message, now_);
  messages_.hear(scan(), now_);
  EXPECT_EQ(sink_.count(Rejection::kNoTransform), 1);
  EXPECT_NE(sink_.reason.find("the pose of the scanner is not known"), std::string::npos) << sink_.reason;

  messages_.hearGoal(goal(5.0), "test", now_);
  drive(2.0);
  EXPECT_EQ(sink_.count(Rejection::kNoTransform), 1);
  ASSERT_EQ(sink_.episodes.size(), 1U);
  ASSERT_FALSE(sink_.episodes[0].steps.empty());
  EXPECT_DOUBLE_EQ(sink_.episodes[0].steps[0].geometry.mount.pose.x, 0.1);
}

TEST_F(DriveMessagesTest, AMountThatIsGivenNeedsNoTransform) {
  const SensorMount mount{{0.3, 0.0, 0.0}, true};
  const tf2::BufferCore nothing;
  ListSink sink;
  DriveMessages messages(nothing, "base_link", mount, RecorderParameters(), &sink);
  messages.hearGoal(goal(5.0), "test", now_);
  for (int i = 0; i < 20; ++i) {
    now_ += ros::Duration(0.1);
    x_ += 0.02;
    messages.hear(odometry(), now_);
    messages.hear(scan(), now_);
  }
  EXPECT_EQ(sink.count(Rejection::kNoTransform), 0);
  ASSERT_FALSE(sink.episodes.empty());
  ASSERT_FALSE(sink.episodes[0].steps.empty());
  EXPECT_TRUE(sink.episodes[0].steps[0].geometry.mount.upside_down);
}

TEST_F(DriveMessagesTest, ATiltedScannerIsRefused) {
  geometry_msgs::TransformStamped transform = toMessage(Pose2{}, "base_footprint", "laser");
  transform.transform.rotation.x = std::sin(0.5);
  transform.transform.rotation.w = std::cos(0.5);
  tf_.setTransform(transform, "test", true);
  drive(1.0);
  EXPECT_EQ(sink_.count(Rejection::kNoTransform), 10);
  EXPECT_NE(sink_.reason.find("tilted"), std::string::npos) << sink_.reason;
}

TEST_F(DriveMessagesTest, WhatIsNotFiniteIsRejected) {
  nav_msgs::Odometry bad_odometry = odometry();
  bad_odometry.twist.twist.angular.z = kInfinity;
  messages_.hear(bad_odometry, now_);
  bad_odometry = odometry();
  bad_odometry.pose.pose.orientation.w = 0.0;
  messages_.hear(bad_odometry, now_);
  messages_.hear(odometry(), now_);
  sensor_msgs::LaserScan bad_scan = scan();
  bad_scan.angle_increment = NAN;
  messages_.hear(bad_scan, now_);
  messages_.hearGoal(goal(kInfinity), "test", now_);
  EXPECT_EQ(sink_.count(Rejection::kNotFinite), 4);
  messages_.hearGoal(goal(5.0, ""), "test", now_);
  EXPECT_EQ(sink_.count(Rejection::kNoTransform), 1) << "a goal without a frame is nowhere";
  drive(1.0);
  EXPECT_TRUE(sink_.episodes.empty());
}

TEST_F(DriveMessagesTest, MessagesWithoutAStampAreOfWhenTheyWereReceived) {
  geometry_msgs::PoseStamped unstamped = goal(5.0);
  unstamped.header.stamp = ros::Time();
  messages_.hearGoal(unstamped, "test", now_);
  for (int i = 0; i < 20; ++i) {
    now_ += ros::Duration(0.1);
    x_ += 0.02;
    nav_msgs::Odometry unstamped_odometry = odometry();
    unstamped_odometry.header.stamp = ros::Time();
    messages_.hear(unstamped_odometry, now_);
    sensor_msgs::LaserScan unstamped_scan = scan();
    unstamped_scan.header.stamp = ros::Time();
    messages_.hear(unstamped_scan, now_);
  }
  messages_.recorder().finish();
  ASSERT_EQ(sink_.episodes.size(), 1U);
  ASSERT_EQ(sink_.episodes[0].steps.size(), 4U);
  EXPECT_DOUBLE_EQ(sink_.episodes[0].steps[1].stamp, 100.5);
}

TEST_F(DriveMessagesTest, AGoalOfLongAgoIsDrivenToFromNowOn) {
  drive(1.0);
  geometry_msgs::PoseStamped old = goal(5.0);
  old.header.stamp -= ros::Duration(60.0);
  messages_.hearGoal(old, "test", now_);
  drive(2.0);
  messages_.recorder().finish();
  ASSERT_EQ(sink_.episodes.size(), 1U);
  EXPECT_DOUBLE_EQ(sink_.episodes[0].episode.begun, 101.0);
  EXPECT_EQ(sink_.count(Rejection::kLate), 0);
}

TEST_F(DriveMessagesTest, AGoalWithoutAHeadingIsAGoal) {
  geometry_msgs::PoseStamped message = goal(5.0);
  message.pose.orientation.w = 0.0;
  messages_.hearGoal(message, "test", now_);
  drive(1.0);
  ASSERT_EQ(sink_.episodes.size(), 1U);
  EXPECT_DOUBLE_EQ(sink_.episodes[0].episode.goal.pose.yaw, 0.0);
}

TEST_F(DriveMessagesTest, AGoalInAFrameThatNobodyKnowsMakesNoSteps) {
  messages_.hearGoal(goal(5.0, "map"), "test", now_);
  drive(2.0);
  EXPECT_TRUE(sink_.episodes.empty());
  EXPECT_GT(sink_.count(Rejection::kNoTransform), 0);
  setTransform("map", "odom", {1.0, 0.0, 0.0});
  drive(2.0);
  ASSERT_EQ(sink_.episodes.size(), 1U);
  EXPECT_NEAR(sink_.episodes[0].steps.at(0).goal.x, 4.0, 1e-9);
}

TEST_F(DriveMessagesTest, CancellingUpToATimeIsHeardByGoalsOfBefore) {
  move_base_msgs::MoveBaseActionGoal message;
  message.goal_id.id = "a";
  message.goal_id.stamp = now_;
  message.goal.target_pose = goal(5.0);
  messages_.hear(message, "test", now_);
  drive(1.0);
  actionlib_msgs::GoalID before;
  before.stamp = ros::Time(99.0);
  messages_.hear(before, now_);
  drive(1.0);
  EXPECT_TRUE(messages_.recorder().goal());
  actionlib_msgs::GoalID after;
  after.stamp = now_;
  messages_.hear(after, now_);
  drive(1.0);
  EXPECT_FALSE(messages_.recorder().goal());
}

TEST_F(DriveMessagesTest, AGoalOfRvizEndsWithTheIdThatMoveBaseMadeForIt) {
  for (const int status : {actionlib_msgs::GoalStatus::ABORTED, actionlib_msgs::GoalStatus::PREEMPTED}) {
    const ros::Time given = now_;
    giveGoalOfRviz(x_ + 5.0);
    drive(2.0);
    EXPECT_TRUE(messages_.recorder().goal());
    giveEnd(status, given);
    drive(2.0);
    EXPECT_FALSE(messages_.recorder().goal());
  }
}

TEST_F(DriveMessagesTest, TheEndOfAnEarlierGoalIsNotThatOfAGoalOfRviz) {
  const ros::Time earlier = now_;
  giveGoalOfRviz(4.0);
  drive(3.0);
  messages_.hearGoal(goal(5.0), "rviz", now_);
  giveEnd(actionlib_msgs::GoalStatus::PREEMPTED, earlier);
  drive(1.0);
  EXPECT_TRUE(messages_.recorder().goal()) << "not passed on yet";
  giveGoalOfRviz(6.0);
  giveEnd(actionlib_msgs::GoalStatus::PREEMPTED, earlier);
  drive(1.0);
  ASSERT_TRUE(messages_.recorder().goal());
  EXPECT_DOUBLE_EQ(messages_.recorder().goal()->pose.x, 6.0);
}

TEST_F(DriveMessagesTest, AGoalInAFrameOfTheRobotStaysWhereItWasGiven) {
  setTransform("base_footprint", "base_link", {0.0, 0.0, 0.0});
  setTransform("odom", "base_footprint", {0.3, 0.0, 0.0});
  drive(1.0);
  messages_.hearGoal(goal(1.0, "base_link"), "test", now_);
  drive(1.0);
  setTransform("odom", "base_footprint", {0.5, 0.0, 0.0});
  drive(1.0);
  ASSERT_EQ(sink_.episodes.size(), 1U);
  for (const DriveStep& step : sink_.episodes[0].steps) EXPECT_DOUBLE_EQ(step.goal.x, 1.3);
  EXPECT_FALSE(sink_.episodes[0].steps.empty());
}

TEST_F(DriveMessagesTest, TransformsInACircleLeadNowhere) {
  setTransform("arm", "hand", {});
  setTransform("hand", "arm", {});
  setTransform("arm", "finger", {});
  drive(1.0);
  messages_.hearGoal(goal(1.0, "finger"), "test", now_);
  drive(1.0);
  EXPECT_TRUE(sink_.episodes.empty());
}

TEST_F(DriveMessagesTest, GoalsAndTheirEndsCountInTheOrderInWhichTheyAreSaid) {
  drive(1.0);
  messages_.hearGoal(goal(4.0), "test", now_);
  drive(1.0);
  const geometry_msgs::PoseStamped next = goal(5.0);  // stamped before the other one is cancelled
  const ros::Time cancelled = now_ + ros::Duration(0.05);
  messages_.hear(actionlib_msgs::GoalID(), cancelled);
  messages_.hearGoal(next, "test", cancelled + ros::Duration(0.01));
  drive(1.0);
  ASSERT_TRUE(messages_.recorder().goal());
  EXPECT_DOUBLE_EQ(messages_.recorder().goal()->pose.x, 5.0);

  geometry_msgs::PoseStamped last = goal(6.0);
  last.header.stamp += ros::Duration(0.4);  // of a computer whose clock is ahead
  messages_.hearGoal(last, "test", now_);
  messages_.hear(actionlib_msgs::GoalID(), now_ + ros::Duration(0.1));
  drive(2.0);
  EXPECT_FALSE(messages_.recorder().goal());
}

const RosProgram program("dataset_recorder_messages", &runTests);

}  // namespace
}  // namespace lstm_planner::dataset_recorder_messages
