#pragma once

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatus.h>
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <move_base_msgs/MoveBaseActionGoal.h>
#include <move_base_msgs/MoveBaseActionResult.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/robot/dataset/dataset.hpp"
#include "ros/fake_robot.hpp"
#include "ros/recorder_process.hpp"
#include "support/scratch_folder.hpp"

namespace lstm_planner {

constexpr double kTick = 0.1;  // s between two scans, each with odometry of the same moment

/// A robot that is driven by the test, in lock step with a recorder: time goes on when everything has been heard.
class RecorderTest : public testing::Test {
 protected:
  RecorderTest()
      : clock_(node_.advertise<rosgraph_msgs::Clock>("/fake_clock", 1, true)),
        scans_(node_.advertise<sensor_msgs::LaserScan>("scan", 10)),
        odometry_(node_.advertise<nav_msgs::Odometry>("odom", 10)),
        simple_goals_(node_.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 10)),
        action_goals_(node_.advertise<move_base_msgs::MoveBaseActionGoal>("move_base/goal", 10)),
        cancels_(node_.advertise<actionlib_msgs::GoalID>("move_base/cancel", 10)),
        results_(node_.advertise<move_base_msgs::MoveBaseActionResult>("move_base/result", 10)) {}
  ~RecorderTest() override {
    recorder_.reset();
    ros::param::del("/dataset_recorder");
  }

  std::string file() const { return folder_ / "drive.sqlite"; }

  /// Another node with the same file.
  std::unique_ptr<RecorderProcess> launch(const std::string& name, std::vector<std::string> arguments) {
    arguments.push_back("_output:=" + file());
    return std::make_unique<RecorderProcess>(name, folder_ / (name + ".log"), arguments);
  }

  /// Returns when it looks at scans; the stamp then is a whole second, and there is no goal.
  void start(const std::vector<std::string>& arguments = {}) {
    recorder_.reset();
    diagnostics_.forget();
    published_ = {};
    publishClock();
    recorder_ = launch("dataset_recorder", arguments);
    const auto connected = [this] {
      const auto hasSubscriber = [](const ros::Publisher* publisher) { return publisher->getNumSubscribers() > 0; };
      const auto publishers = {&scans_, &odometry_, &simple_goals_, &action_goals_, &cancels_, &results_};
      return std::all_of(publishers.begin(), publishers.end(), hasSubscriber) &&
             ros::service::exists("dataset_recorder/pause", false);
    };
    insist("the recorder is not connected", [&] { return eventually(connected); });
    pause_ = node_.serviceClient<std_srvs::SetBool>("dataset_recorder/pause", true);
    // Until it knows where the scanner sits.
    insist("the recorder looks at no scan", [this] {
      stand(kTick);
      return count("rejected: no goal") > 0 || count("rejected: standing") > 0;
    });
    while (std::fmod(ros::Time::now().toSec(), 1.0) != 0.0) stand(kTick);
  }

  std::string value(const std::string& key) { return diagnostics_.value("dataset_recorder", key); }
  long count(const std::string& key) { return diagnostics_.count("dataset_recorder", key); }

  /// Drives straight to `pose` at a constant speed.
  void drive(const Pose2& pose, double seconds) {
    const Pose2 from = robot_.pose();
    const int ticks = static_cast<int>(std::lround(seconds / kTick));
    for (int i = 1; i <= ticks; ++i) {
      const double share = static_cast<double>(i) / ticks;
      passTime(kTick);
      sense({from.x + share * (pose.x - from.x), from.y + share * (pose.y - from.y),
             from.yaw + share * (pose.yaw - from.yaw)});
    }
  }
  void stand(double seconds) { drive(robot_.pose(), seconds); }

  void passTime(double seconds) {
    robot_.wait(seconds);
    publishClock();
  }
  void sense(const Pose2& pose) {
    robot_.moveTo(pose, 0.0);
    ++published_.scans;
    ++published_.odometry;
    synchronise();
  }

  static geometry_msgs::PoseStamped goalAt(double x, double y, const std::string& frame = "odom") {
    geometry_msgs::PoseStamped goal;
    goal.header.frame_id = frame;
    goal.header.stamp = ros::Time::now();
    goal.pose = toMessage({x, y, 0.0});
    return goal;
  }
  void giveGoal(const geometry_msgs::PoseStamped& goal) { giveEvent(simple_goals_, goal); }
  void giveActionGoal(const geometry_msgs::PoseStamped& goal, const std::string& id) {
    move_base_msgs::MoveBaseActionGoal message;
    message.header.stamp = ros::Time::now();
    message.goal_id.id = id;
    message.goal_id.stamp = ros::Time::now();
    message.goal.target_pose = goal;
    giveEvent(action_goals_, message);
  }
  void giveResult(int status, const std::string& id) {
    move_base_msgs::MoveBaseActionResult message;
    message.header.stamp = ros::Time::now();
    message.status.status = static_cast<decltype(message.status.status)>(status);
    message.status.goal_id.id = id;
    giveEvent(results_, message);
  }
  void giveCancel(const std::string& id) {
    actionlib_msgs::GoalID message;
    message.id = id;
    giveEvent(cancels_, message);
  }

  std::string pause(bool paused) {
    std_srvs::SetBool call;
    call.request.data = static_cast<unsigned char>(paused);
    is_paused_ = paused;
    if (!pause_.call(call)) throw std::runtime_error("the recorder does not answer");
    EXPECT_TRUE(call.response.success);
    return call.response.message;
  }
  std_srvs::Trigger::Response trigger(const std::string& service) {
    std_srvs::Trigger call;
    EXPECT_TRUE(ros::service::call("dataset_recorder/" + service, call));
    return call.response;
  }

  /// Everything that was recorded, once the node has ended.
  lstm_planner::Dataset finish() {
    EXPECT_TRUE(trigger("finish").success);
    EXPECT_EQ(recorder_->wait(), 0);
    return readDataset(file());
  }

  /// Waits until all that was published has been heard. The service makes the recorder say what it has heard.
  void synchronise() {
    insist("the recorder has not heard all", [this] {
      pause(is_paused_);
      return count("scans heard") >= published_.scans && count("odometry heard") >= published_.odometry &&
             count("goals heard") >= published_.goals;
    });
  }

  FakeRobot robot_;
  test::ScratchFolder folder_;
  std::unique_ptr<RecorderProcess> recorder_;
  RecorderDiagnostics diagnostics_;

 private:
  struct Published {
    long scans = 0;
    long odometry = 0;
    long goals = 0;
  };

  /// Nothing that comes later would make sense: ends the test. A busy computer starts a process in many seconds.
  static void insist(const std::string& otherwise, const std::function<bool()>& condition) {
    if (!eventually(condition) && !eventually(condition)) throw std::runtime_error(otherwise);
  }

  void publishClock() {
    rosgraph_msgs::Clock clock;
    clock.clock = ros::Time::now();
    clock_.publish(clock);
  }

  template <typename Message>
  void giveEvent(const ros::Publisher& publisher, const Message& message) {
    publisher.publish(message);
    ++published_.goals;
    synchronise();
  }

  ros::NodeHandle node_;
  ros::Publisher clock_;
  ros::Publisher scans_;
  ros::Publisher odometry_;
  ros::Publisher simple_goals_;
  ros::Publisher action_goals_;
  ros::Publisher cancels_;
  ros::Publisher results_;
  ros::ServiceClient pause_;
  bool is_paused_ = false;
  Published published_;
};

inline std::vector<int> labelsOf(const RecordedEpisode& episode) {
  std::vector<int> labels;
  for (const DriveStep& step : episode.steps) labels.push_back(step.label);
  return labels;
}

}  // namespace lstm_planner
