// Plays move_base for demo_runner, each goal in another way, and reads what the runner made of it.
#include <actionlib/server/simple_action_server.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <std_msgs/UInt32.h>
#include <tf2/utils.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ros/fixtures/ros_program.hpp"
#include "ros/fixtures/waiting.hpp"
#include "support/picture_check.hpp"

namespace lstm_planner::demo_runner_behaviour {
namespace {

constexpr double kDeadline = 60.0;  // s of the computer's clock after which a test has failed

/// A move_base that does with its goals, one after another, what the parameter ~behaviours says: drive, abort, lie
/// (claim success at once), hang (never end), ram (drive on until something is touched).
class MoveBase {
 public:
  MoveBase() : server_(node_, "move_base", false) {
    EXPECT_TRUE(ros::param::get("~behaviours", behaviours_));
    odometry_subscriber_ = node_.subscribe("odom", 10, &MoveBase::onOdometry, this);
    contacts_subscriber_ = node_.subscribe("create2_stub/contacts", 10, &MoveBase::onContacts, this);
    commands_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    server_.registerGoalCallback([this] {
      goals.push_back(server_.acceptNewGoal()->target_pose);
      behaviour_ = goals.size() <= behaviours_.size() ? behaviours_[goals.size() - 1] : "abort";
      if (behaviour_ == "abort") server_.setAborted({}, "there is no path");
      if (behaviour_ == "lie") server_.setSucceeded({}, "here we are");
    });
    server_.registerPreemptCallback([this] { server_.setPreempted({}, "cancelled"); });
    server_.start();
  }

  std::vector<geometry_msgs::PoseStamped> goals;

 private:
  void onContacts(const std_msgs::UInt32::ConstPtr& message) { contacts_ = message->data; }

  void onOdometry(const nav_msgs::Odometry::ConstPtr& message) {
    if (!server_.isActive() || behaviour_ == "hang") return;
    const auto& pose = message->pose.pose;
    const auto& goal = goals.back().pose;
    const double dx = goal.position.x - pose.position.x;
    const double dy = goal.position.y - pose.position.y;
    geometry_msgs::Twist command;
    if (behaviour_ == "ram" && contacts_ > 0) {
      server_.setAborted({}, "something is in the way");
    } else if (behaviour_ == "drive" && std::hypot(dx, dy) < 0.1) {
      server_.setSucceeded({}, "arrived");
    } else {
      const double error = std::remainder(std::atan2(dy, dx) - tf2::getYaw(pose.orientation), 2.0 * M_PI);
      command.angular.z = std::clamp(1.5 * error, -1.0, 1.0);
      command.linear.x = std::abs(error) < 0.2 ? 0.3 : 0.0;
    }
    commands_.publish(command);
  }

  ros::NodeHandle node_;
  actionlib::SimpleActionServer<move_base_msgs::MoveBaseAction> server_;
  ros::Subscriber odometry_subscriber_;
  ros::Subscriber contacts_subscriber_;
  ros::Publisher commands_;
  std::vector<std::string> behaviours_;
  std::string behaviour_;
  unsigned contacts_ = 0;
};

/// The runner's result once it is final: the exit code and the JSON behind it.
struct Result {
  int exit_code = -1;
  nlohmann::json json;

  bool read(const std::string& path) {
    std::ifstream file(path);
    if (!(file >> exit_code)) return false;
    json = nlohmann::json::parse(file, nullptr, false);
    return !json.is_discarded() && json.value("error", "") != "the demo did not end by itself";
  }
};

class DemoRunner : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string path;
    ASSERT_TRUE(ros::param::get("demo_runner/result", path));
    ASSERT_TRUE(eventually([&] { return result_.read(path); }, kDeadline, spinBriefly))
        << "no final result in " << path;
    std::remove(path.c_str());
  }
  const nlohmann::json& leg(std::size_t index) const { return result_.json["legs"].at(index); }

  MoveBase move_base_;
  Result result_;
};

TEST_F(DemoRunner, SendsGoalsInTheOdometryFrameAndIsContentWhenAllAreReached) {
  EXPECT_EQ(result_.exit_code, 0);
  EXPECT_EQ(result_.json["reached"], 2);
  EXPECT_EQ(result_.json["contacts"], 0);
  ASSERT_EQ(move_base_.goals.size(), 2u);
  // The robot starts at (3, 1) looking along the map's y axis: (3, 2) is one metre ahead of it.
  EXPECT_EQ(move_base_.goals[0].header.frame_id, "odom");
  EXPECT_NEAR(move_base_.goals[0].pose.position.x, 1.0, 1e-6);
  EXPECT_NEAR(move_base_.goals[0].pose.position.y, 0.0, 1e-6);
  EXPECT_NEAR(tf2::getYaw(move_base_.goals[0].pose.orientation), -M_PI / 2.0, 1e-6);
  // A straight path of 1 m that ends 0.1 m early or up to one loop of the driver and the braking later.
  EXPECT_NEAR(leg(0)["path_m"].get<double>(), 0.9, 0.1);
  // The grid knows each end of the path to its cell of 0.05 m.
  EXPECT_NEAR(leg(0)["shortest_m"].get<double>(), 1.0, 2 * 0.05);
  EXPECT_GT(leg(0)["time_s"].get<double>(), 0.8 / 0.5);
  std::string picture;
  ASSERT_TRUE(ros::param::get("demo_runner/picture", picture));
  lstm_planner::test::expectPicture(picture);
  std::remove(picture.c_str());
}

TEST_F(DemoRunner, CountsEveryWayOfMissingAGoal) {
  EXPECT_EQ(result_.exit_code, 1);
  EXPECT_EQ(result_.json["goals"], 5);
  EXPECT_EQ(result_.json["reached"], 1);
  EXPECT_EQ(result_.json["contacts"], 1);
  ASSERT_EQ(result_.json["legs"].size(), 5u);
  EXPECT_TRUE(leg(0)["reached"]);
  EXPECT_FALSE(leg(1)["reached"]);
  EXPECT_EQ(leg(1)["text"], "there is no path");
  EXPECT_FALSE(leg(2)["reached"]);
  EXPECT_EQ(leg(2)["text"], "the action succeeded, but the robot is not there");
  EXPECT_FALSE(leg(3)["reached"]);
  EXPECT_EQ(leg(3)["text"], "time limit");
  EXPECT_GE(leg(3)["time_s"].get<double>(), 1.0);
  EXPECT_FALSE(leg(4)["reached"]);
  EXPECT_EQ(leg(4)["contacts"], 1);
  EXPECT_TRUE(leg(4)["shortest_m"].is_null()) << "that goal is too near to the wall for the robot";
}

const RosProgram program("demo_runner_behaviour", &runTests);

}  // namespace
}  // namespace lstm_planner::demo_runner_behaviour
