// The recorder beside the simulated robot, both with the rates and delays that they have.

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <visualization_msgs/MarkerArray.h>

#include <filesystem>
#include <set>
#include <string>

#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/fixtures/recorder_process.hpp"
#include "ros/fixtures/ros_program.hpp"

namespace lstm_planner::dataset_recorder_stub {
namespace {

class StubDrive : public testing::Test {
 protected:
  StubDrive()
      : commands_(node_.advertise<geometry_msgs::Twist>("cmd_vel", 1)),
        goals_(node_.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 1)),
        markers_(callbacks_.nodeHandle().subscribe("dataset_recorder/markers", 10, &StubDrive::onMarkers, this)) {
    ros::param::get("/dataset_recorder/output", file_);
  }
  ~StubDrive() override { std::filesystem::remove(file_); }

  void onMarkers(const visualization_msgs::MarkerArray::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& marker : message->markers) {
      if (marker.action == visualization_msgs::Marker::ADD) seen_.insert(marker.ns);
    }
  }
  std::set<std::string> seenMarkers() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return seen_;
  }

  void command(double speed) {
    geometry_msgs::Twist twist;
    twist.linear.x = speed;
    commands_.publish(twist);
  }

  std::string file_;
  std::mutex mutex_;
  std::set<std::string> seen_;
  ros::NodeHandle node_;
  CallbackThread callbacks_;
  RecorderDiagnostics diagnostics_;
  ros::Publisher commands_;
  ros::Publisher goals_;
  ros::Subscriber markers_;
};

TEST_F(StubDrive, StraightToAGoalIsRecordedStepByStep) {
  ASSERT_TRUE(eventually([&] {
    return commands_.getNumSubscribers() > 0 && goals_.getNumSubscribers() > 0 && markers_.getNumPublishers() > 0;
  }));
  geometry_msgs::PoseStamped goal;
  goal.header.frame_id = "odom";
  goal.pose = toMessage({1.2, 0.0, 0.0});
  goals_.publish(goal);
  // At 0.2 m/s to within 0.3 m of the goal.
  const auto arrived = [&] {
    command(0.2);
    return diagnostics_.count("dataset_recorder", "episodes arrived") == 1;
  };
  ASSERT_TRUE(eventually(arrived) || eventually(arrived));
  EXPECT_EQ(seenMarkers(), (std::set<std::string>{"goal", "labels", "sectors", "path"}));
  std_srvs::Trigger finish;
  ASSERT_TRUE(ros::service::call("dataset_recorder/finish", finish));
  EXPECT_TRUE(finish.response.success) << finish.response.message;

  const Dataset dataset = readDataset(file_, true);
  ASSERT_EQ(dataset.recordings.size(), 1U);
  ASSERT_EQ(dataset.recordings[0].episodes.size(), 1U);
  const RecordedEpisode& episode = dataset.recordings[0].episodes[0];
  EXPECT_EQ(episode.episode.end, EpisodeEnd::kArrived);
  // 0.9 m in steps of 0.1 m, of which the first and the last are shorter.
  EXPECT_GE(episode.steps.size(), 7U);
  EXPECT_LE(episode.steps.size(), 10U);
  for (const DriveStep& step : episode.steps) {
    const bool starts = step.number == 0;  // until the robot has moved at all
    EXPECT_EQ(step.label, 2);
    EXPECT_EQ(step.ranges.size(), 1081U);
    if (!starts) {
      EXPECT_NEAR(step.next_stamp - step.stamp, 0.5, 0.025 + 1e-6) << "of scans at 40 Hz";
    }
    EXPECT_NEAR(step.observation.goal_distance, 1.2 - step.pose.x, 1e-3);
  }
}

const RosProgram program("dataset_recorder_stub", &runTests);

}  // namespace
}  // namespace lstm_planner::dataset_recorder_stub
