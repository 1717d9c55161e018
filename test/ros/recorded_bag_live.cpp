// A bag gives what the node makes of the same messages, step for step.

#include <actionlib_msgs/GoalID.h>
#include <gtest/gtest.h>
#include <move_base_msgs/MoveBaseActionGoal.h>
#include <move_base_msgs/MoveBaseActionResult.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <map>

#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/ros/recorder/bag_drive.hpp"
#include "ros/fixtures/drive_bag.hpp"
#include "ros/fixtures/recorder_process.hpp"
#include "ros/fixtures/ros_program.hpp"
#include "support/scratch_folder.hpp"

namespace lstm_planner::recorded_bag_live {
namespace {

/// Publishes a bag's messages in lock step with the node dataset_recorder: the next one when one has been heard. Its
/// clock is the computer's, far from that of the robot in the bag.
class LiveBag {
 public:
  explicit LiveBag(const std::string& path) : bag_(path) {
    publishers_["/scan"] = node_.advertise<sensor_msgs::LaserScan>("scan", 10);
    publishers_["/odom"] = node_.advertise<nav_msgs::Odometry>("odom", 10);
    publishers_["/tf"] = node_.advertise<tf2_msgs::TFMessage>("/tf", 10);
    publishers_["/tf_static"] = node_.advertise<tf2_msgs::TFMessage>("/tf_static", 10, true);
    publishers_["/move_base_simple/goal"] = node_.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 10);
    publishers_["/move_base/goal"] = node_.advertise<move_base_msgs::MoveBaseActionGoal>("move_base/goal", 10);
    publishers_["/move_base/cancel"] = node_.advertise<actionlib_msgs::GoalID>("move_base/cancel", 10);
    publishers_["/move_base/result"] = node_.advertise<move_base_msgs::MoveBaseActionResult>("move_base/result", 10);
  }

  Dataset record() {
    const std::string file = folder_ / "live.sqlite";
    RecorderProcess recorder("dataset_recorder", folder_ / "log", {"_output:=" + file});
    const auto isHeard = [](const auto& publisher) { return publisher.second.getNumSubscribers() > 0; };
    EXPECT_TRUE(eventually([&] {
      return std::all_of(publishers_.begin(), publishers_.end(), isHeard) &&
             ros::service::exists("dataset_recorder/pause", false);
    }));
    pause_ = node_.serviceClient<std_srvs::SetBool>("dataset_recorder/pause", true);
    rosbag::View view(bag_);
    for (const rosbag::MessageInstance& message : view) {
      publish(message);
      if (testing::Test::HasFailure()) return {};
    }
    std_srvs::Trigger finish;
    EXPECT_TRUE(ros::service::call("dataset_recorder/finish", finish));
    EXPECT_EQ(recorder.wait(), 0);
    return readDataset(file, true);
  }

 private:
  void publish(const rosbag::MessageInstance& message) {
    const std::string topic = message.getTopic();
    publishers_.at(topic).publish(message);
    if (topic == "/tf" || topic == "/tf_static") return;
    const std::string counter = topic == "/scan" ? "scans heard" : topic == "/odom" ? "odometry heard" : "goals heard";
    const long count = ++published_[counter];
    EXPECT_TRUE(eventually([&] {
      // The service makes the recorder say what it has heard.
      std_srvs::SetBool keep_on;
      pause_.call(keep_on);
      return diagnostics_.count("dataset_recorder", counter) >= count;
    })) << counter
        << ": " << count;
  }

  ros::NodeHandle node_;
  rosbag::Bag bag_;
  std::map<std::string, ros::Publisher> publishers_;
  std::map<std::string, long> published_;
  ros::ServiceClient pause_;
  RecorderDiagnostics diagnostics_;
  test::ScratchFolder folder_;
};

void expectSame(const Pose2& a, const Pose2& b) {
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.yaw, b.yaw);
}

/// All numbers are equal, not nearly so.
void expectSame(const DriveStep& a, const DriveStep& b) {
  EXPECT_EQ(a.number, b.number);
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.next_stamp, b.next_stamp);
  expectSame(a.pose, b.pose);
  expectSame(a.next_pose, b.next_pose);
  EXPECT_EQ(a.twist.linear, b.twist.linear);
  EXPECT_EQ(a.twist.angular, b.twist.angular);
  EXPECT_EQ(a.goal.x, b.goal.x);
  EXPECT_EQ(a.goal.y, b.goal.y);
  EXPECT_EQ(a.minimum_ranges, b.minimum_ranges);
  EXPECT_EQ(a.beams, b.beams);
  EXPECT_EQ(a.measured, b.measured);
  EXPECT_EQ(a.driven_angle, b.driven_angle);
  EXPECT_EQ(a.label, b.label);
  EXPECT_EQ(a.geometry, b.geometry);
  EXPECT_EQ(a.observation.sector_ranges, b.observation.sector_ranges);
  EXPECT_EQ(a.observation.goal_distance, b.observation.goal_distance);
  EXPECT_EQ(a.observation.goal_bearing, b.observation.goal_bearing);
  EXPECT_EQ(a.observation.heading, b.observation.heading);
  EXPECT_EQ(a.observation.previous_action, b.observation.previous_action);
  EXPECT_EQ(a.observation.visits, b.observation.visits);
  EXPECT_EQ(a.observation.route_bearing, b.observation.route_bearing);
  EXPECT_EQ(a.observation.route_length, b.observation.route_length);
  ASSERT_EQ(a.ranges.size(), b.ranges.size());
  for (std::size_t i = 0; i < a.ranges.size(); ++i) {
    EXPECT_TRUE(a.ranges[i] == b.ranges[i] || (std::isnan(a.ranges[i]) && std::isnan(b.ranges[i]))) << i;
  }
}

TEST(RecordedBagLiveTest, ABagGivesWhatTheNodeMakesOfTheSameMessages) {
  const test::ScratchFolder folder;
  const std::string path = folder / "drive.bag";
  DriveBagContent content;
  content.clock_ahead = 8.0 * 24.0 * 3600.0;
  DriveBag::write(path, content);
  RecordingSink sink({});
  recordBags({path}, {}, {}, &sink);
  const Recording& from_bag = sink.recording();

  const Dataset live = LiveBag(path).record();
  ASSERT_EQ(live.recordings.size(), 1u);
  const Recording& recording = live.recordings[0];
  EXPECT_EQ(recording.rejections, from_bag.rejections);
  ASSERT_EQ(recording.episodes.size(), 5u);
  ASSERT_EQ(from_bag.episodes.size(), 5u);
  long steps = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    SCOPED_TRACE("episode " + std::to_string(i));
    const Episode& a = recording.episodes[i].episode;
    const Episode& b = from_bag.episodes[i].episode;
    EXPECT_EQ(a.end, b.end);
    EXPECT_EQ(a.begun, b.begun);
    EXPECT_EQ(a.ended, b.ended);
    EXPECT_EQ(a.goal_source, b.goal_source);
    EXPECT_EQ(a.goal.frame, b.goal.frame);
    expectSame(a.goal.pose, b.goal.pose);
    ASSERT_EQ(recording.episodes[i].steps.size(), from_bag.episodes[i].steps.size());
    for (std::size_t k = 0; k < from_bag.episodes[i].steps.size(); ++k) {
      SCOPED_TRACE("step " + std::to_string(k));
      expectSame(recording.episodes[i].steps[k], from_bag.episodes[i].steps[k]);
      ++steps;
    }
  }
  EXPECT_GT(steps, 35);  // two a second for some 20 s of driving with a goal
}

const RosProgram program("recorded_bag_live", &runTestsBesideSpinner);

}  // namespace
}  // namespace lstm_planner::recorded_bag_live
