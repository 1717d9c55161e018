// The stub on one of its three clocks; the .test files choose. All times are stamps, never the computer's clock, which
// only ends what would wait for ever.
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Float32.h>
#include <std_msgs/UInt32.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <tf2/utils.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>
#include <tf2_ros/transform_listener.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <set>
#include <thread>
#include <vector>

#include "ros/fixtures/ros_program.hpp"
#include "ros/fixtures/waiting.hpp"

namespace lstm_planner::create2_stub_behaviour {
namespace {

constexpr double kDeadline = 30.0;        // s of the computer's clock after which a test has failed
constexpr double kRobotRadius = 0.17425;  // m
constexpr double kScanPeriod = 0.025;     // s, of ~ground_truth too
constexpr double kClockPeriod = 0.01;     // s, resolution of a simulated clock
constexpr double kClockLead = 0.05;       // s; the stub stops a robot whose last command is 0.2 s old

/// s, of the newest ground truth that the running test has seen; 0 before its first.
std::atomic<double> truth_time{0.0};

/// Plays the simulator whose /clock the stub follows. It waits for a test that the computer gives no time to: otherwise
/// the robot would stop for want of commands.
class ClockSource {
 public:
  explicit ClockSource(bool wanted) {
    if (!wanted) return;
    publisher_ = ros::NodeHandle().advertise<rosgraph_msgs::Clock>("/clock", 10);
    thread_ = std::thread([this] {
      rosgraph_msgs::Clock message;
      message.clock = ros::Time(50.0);
      for (ros::WallRate rate(2.0 / kClockPeriod); running_; rate.sleep()) {
        const double seen = truth_time;
        if (seen > 0.0 && message.clock.toSec() > seen + kClockLead) continue;
        message.clock += ros::Duration(kClockPeriod);
        publisher_.publish(message);
      }
    });
  }
  ~ClockSource() {
    running_ = false;
    if (thread_.joinable()) thread_.join();
  }

 private:
  ros::Publisher publisher_;
  std::atomic<bool> running_{true};
  std::thread thread_;
};

class Create2Stub : public ::testing::Test {
 protected:
  void SetUp() override {
    truth_time = 0.0;
    truth_subscriber_ = node_.subscribe("create2_stub/ground_truth", 1000, &Create2Stub::onTruth, this);
    odometry_subscriber_ = node_.subscribe("odom", 1000, &Create2Stub::onOdometry, this);
    scan_subscriber_ = node_.subscribe("scan", 1000, &Create2Stub::onScan, this);
    tf_subscriber_ = node_.subscribe("tf", 1000, &Create2Stub::onTransforms, this);
    contacts_subscriber_ = node_.subscribe("create2_stub/contacts", 10, &Create2Stub::onContacts, this);
    commands_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    ASSERT_TRUE(spinUntil([this] {
      return commands_.getNumSubscribers() > 0 && !truths_.empty() && !odometries_.empty() && !scans_.empty();
    }));
  }

  bool spinUntil(const std::function<bool()>& condition) {
    return eventually(condition, kDeadline, [] {
      ros::spinOnce();
      ros::WallDuration(0.0005).sleep();
    });
  }

  double time() const { return truths_.back().header.stamp.toSec(); }
  const nav_msgs::Odometry& truth() const { return truths_.back(); }

  void command(double linear, double angular) {
    geometry_msgs::Twist message;
    message.linear.x = linear;
    message.angular.z = angular;
    commands_.publish(message);
  }

  /// Commands the speed over and over until the condition holds; returns the time of the last command.
  double driveUntil(double linear, double angular, const std::function<bool()>& condition) {
    double sent = -1.0;
    const bool ended = spinUntil([&] {
      if (condition()) return true;
      if (time() - sent >= 0.05) {
        command(linear, angular);
        sent = time();
      }
      return false;
    });
    EXPECT_TRUE(ended) << "the robot did not get there in " << kDeadline << " s";
    return sent;
  }

  bool waitFor(double seconds) {
    const double end = time() + seconds;
    return spinUntil([this, end] { return time() >= end; });
  }

  /// The first and the last of the newest `count` ground truths are the same.
  bool isStill(std::size_t count) const {
    if (truths_.size() < count) return false;
    const auto& before = truths_[truths_.size() - count].pose.pose;
    return distance(before, truth().pose.pose) == 0.0 && before.orientation.z == truth().pose.pose.orientation.z;
  }

  bool waitUntilStill() {
    return spinUntil([this] { return isStill(12); });
  }

  static double distance(const geometry_msgs::Pose& a, const geometry_msgs::Pose& b) {
    return std::hypot(a.position.x - b.position.x, a.position.y - b.position.y);
  }

  ros::NodeHandle node_;
  ros::Publisher commands_;
  std::vector<nav_msgs::Odometry> truths_;
  std::vector<nav_msgs::Odometry> odometries_;
  std::vector<sensor_msgs::LaserScan> scans_;
  std::set<ros::Time> transform_stamps_;
  unsigned contacts_ = 0;

 private:
  void onTruth(const nav_msgs::Odometry::ConstPtr& message) {
    truths_.push_back(*message);
    truth_time = time();
  }
  void onScan(const sensor_msgs::LaserScan::ConstPtr& message) { scans_.push_back(*message); }
  void onContacts(const std_msgs::UInt32::ConstPtr& message) { contacts_ = message->data; }
  void onTransforms(const tf2_msgs::TFMessage::ConstPtr& message) {
    for (const auto& transform : message->transforms) transform_stamps_.insert(transform.header.stamp);
  }
  void onOdometry(const nav_msgs::Odometry::ConstPtr& message) { odometries_.push_back(*message); }

  ros::Subscriber truth_subscriber_;
  ros::Subscriber odometry_subscriber_;
  ros::Subscriber scan_subscriber_;
  ros::Subscriber tf_subscriber_;
  ros::Subscriber contacts_subscriber_;
};

/// Between the footprint and the obstacle ahead, m: a wall along the x axis or a circle.
double gap(const geometry_msgs::Point& position) {
  double wall_y = 0.0;
  if (ros::param::get("~wall_y", wall_y)) return position.y - wall_y - kRobotRadius;
  double x = 0.0;
  double radius = 0.0;
  EXPECT_TRUE(ros::param::get("~circle_x", x) && ros::param::get("~circle_radius", radius));
  return std::hypot(position.x - x, position.y) - radius - kRobotRadius;
}

// The first test, before anything has moved.
TEST_F(Create2Stub, StartsItsOdometryAtZeroWhereverTheRobotStands) {
  const auto& pose = odometries_.front().pose.pose;
  EXPECT_EQ(pose.position.x, 0.0);
  EXPECT_EQ(pose.position.y, 0.0);
  EXPECT_EQ(tf2::getYaw(pose.orientation), 0.0);
  EXPECT_GT(std::hypot(truth().pose.pose.position.x, truth().pose.pose.position.y), 0.5);
}

TEST_F(Create2Stub, NamesTheFramesOfDriverAndScanner) {
  EXPECT_EQ(odometries_.back().header.frame_id, "odom");
  EXPECT_EQ(odometries_.back().child_frame_id, "base_footprint");
  EXPECT_EQ(scans_.back().header.frame_id, "laser");
  EXPECT_EQ(truth().header.frame_id, "map");
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener(buffer);
  ASSERT_TRUE(spinUntil([&] { return buffer.canTransform("odom", "laser", ros::Time(0)); }));
  const auto laser = buffer.lookupTransform("base_footprint", "laser", ros::Time(0)).transform;
  EXPECT_NEAR(laser.translation.z, 0.017 + 0.125, 1e-9);
  EXPECT_EQ(buffer.lookupTransform("base_footprint", "base_link", ros::Time(0)).transform.translation.z, 0.017);
}

TEST_F(Create2Stub, PublishesTheScansOfAUtm30Lx) {
  const sensor_msgs::LaserScan& scan = scans_.back();
  EXPECT_EQ(scan.ranges.size(), 1081u);
  EXPECT_FLOAT_EQ(scan.angle_min, -2.35619F);
  EXPECT_NEAR(scan.angle_max, 2.35619, 1e-4);
  EXPECT_FLOAT_EQ(scan.angle_increment, 0.00436332F);
  EXPECT_NEAR(scan.time_increment, 1.7361e-5, 1e-9);  // as urg_node rounds it
  EXPECT_FLOAT_EQ(scan.range_min, 0.023F);
  EXPECT_FLOAT_EQ(scan.range_max, 60.0F);
}

TEST_F(Create2Stub, ScansAt40HzAndLoopsAt10Hz) {
  ASSERT_TRUE(spinUntil([this] { return scans_.size() > 80 && odometries_.size() > 20; }));
  for (std::size_t i = 1; i < scans_.size(); ++i) {
    ASSERT_NEAR((scans_[i].header.stamp - scans_[i - 1].header.stamp).toSec(), kScanPeriod, 1e-6) << "scan " << i;
  }
  const auto rounds = static_cast<double>(odometries_.size() - 1);
  const double span = (odometries_.back().header.stamp - odometries_.front().header.stamp).toSec();
  // On the computer's clock a stamp is late by what the scheduler takes; the mean is not.
  EXPECT_NEAR(span / rounds, 0.1, 0.005);
}

TEST_F(Create2Stub, SendsATransformWithEveryOdometry) {
  const std::size_t before = odometries_.size();
  ASSERT_TRUE(spinUntil([&] { return odometries_.size() > before + 10; }));
  const ros::Time last = odometries_[before + 9].header.stamp;
  ASSERT_TRUE(spinUntil([&] { return !transform_stamps_.empty() && *transform_stamps_.rbegin() >= last; }));
  for (std::size_t i = before; i < before + 10; ++i) {
    // Each has its own stamp; those of one round of the loop are far closer than two rounds.
    const ros::Time stamp = odometries_[i].header.stamp;
    const auto next = transform_stamps_.lower_bound(stamp);
    ASSERT_NE(next, transform_stamps_.end());
    EXPECT_LT((*next - stamp).toSec(), 0.05);
  }
}

TEST_F(Create2Stub, PublishesWheelsAndBattery) {
  sensor_msgs::JointState joints;
  double ratio = -1.0;
  const auto joints_subscriber = node_.subscribe<sensor_msgs::JointState>(
      "joint_states", 10, [&](const sensor_msgs::JointState::ConstPtr& message) { joints = *message; });
  const auto battery_subscriber = node_.subscribe<std_msgs::Float32>(
      "battery/charge_ratio", 10, [&](const std_msgs::Float32::ConstPtr& message) { ratio = message->data; });
  ASSERT_TRUE(spinUntil([&] { return joints.name.size() == 2 && ratio >= 0.0; }));
  EXPECT_EQ(joints.name[0], "left_wheel_joint");
  EXPECT_EQ(joints.name[1], "right_wheel_joint");
  EXPECT_GT(ratio, 0.0);
  EXPECT_LE(ratio, 1.0);
}

TEST_F(Create2Stub, StopsTwoToThreeTenthsOfASecondAfterTheLastCommand) {
  const double speed = 0.2;
  const double begin = time();
  const double sent = driveUntil(speed, 0.0, [&] { return time() > begin + 1.0; });
  ASSERT_TRUE(waitUntilStill());
  double braked = 0.0;
  for (std::size_t i = 1; i < truths_.size() && braked == 0.0; ++i) {
    const double stamp = truths_[i].header.stamp.toSec();
    const double step = distance(truths_[i - 1].pose.pose, truths_[i].pose.pose);
    if (stamp > sent && step < 0.95 * speed * kScanPeriod) braked = stamp;
  }
  // Up to one period of the ground truth passes until braking shows, and the time of sending is known to as much.
  EXPECT_GE(braked - sent, 0.2);
  EXPECT_LE(braked - sent, 0.3 + 2.0 * kScanPeriod + kClockPeriod);
}

TEST_F(Create2Stub, MeasuresTwistInTheBaseFrameAndPoseInTheOdometryFrame) {
  const auto before = odometries_.back().pose.pose;
  const double begin = time();
  driveUntil(0.0, 0.8, [&] { return time() > begin + 1.0; });
  // A tick of the encoders in the 15 ms between two packets is 0.03 m/s, of both wheels 0.25 rad/s.
  EXPECT_NEAR(odometries_.back().twist.twist.angular.z, 0.8, 0.26);
  EXPECT_NEAR(odometries_.back().twist.twist.linear.x, 0.0, 0.031);
  ASSERT_TRUE(waitUntilStill() && waitFor(0.2));
  EXPECT_EQ(odometries_.back().twist.twist.angular.z, 0.0);
  const double turned = tf2::getYaw(odometries_.back().pose.pose.orientation) - tf2::getYaw(before.orientation);
  EXPECT_NEAR(turned, 0.8 * (1.0 + 0.25), 0.15);
  driveUntil(0.0, -0.8, [&] { return tf2::getYaw(odometries_.back().pose.pose.orientation) <= 0.2; });
  ASSERT_TRUE(waitUntilStill());
}

TEST_F(Create2Stub, PausesScansOnRequest) {
  std_srvs::SetBool pause;
  pause.request.data = true;
  ASSERT_TRUE(ros::service::call("create2_stub/pause_scan", pause));
  ASSERT_TRUE(waitFor(0.2));  // what was on its way has arrived
  const double paused = time();
  ASSERT_TRUE(waitFor(1.0));
  EXPECT_LT(scans_.back().header.stamp.toSec(), paused);
  pause.request.data = false;
  ASSERT_TRUE(ros::service::call("create2_stub/pause_scan", pause));
  EXPECT_TRUE(spinUntil([&] { return scans_.back().header.stamp.toSec() > paused + 1.0; }));
}

TEST_F(Create2Stub, JumpsInOdometryOnlyOnRequest) {
  ASSERT_TRUE(waitUntilStill() && waitFor(0.3));
  const auto odometry_before = odometries_.back().pose.pose;
  const auto truth_before = truth().pose.pose;
  std_srvs::Trigger jump;
  ASSERT_TRUE(ros::service::call("create2_stub/jump_odometry", jump));
  ASSERT_TRUE(spinUntil([&] { return distance(odometry_before, odometries_.back().pose.pose) > 0.1; }));
  EXPECT_NEAR(distance(odometry_before, odometries_.back().pose.pose), 1.0, 1e-9);
  EXPECT_EQ(distance(truth_before, truth().pose.pose), 0.0);
}

TEST_F(Create2Stub, HoldsTheRobotAtAnObstacleAndCountsTheContactOnce) {
  // The tests before drove the robot along its line and turned it.
  double start_yaw = 0.0;
  ASSERT_TRUE(ros::param::get("~start_yaw", start_yaw));
  const auto error = [&] { return std::remainder(start_yaw - tf2::getYaw(truth().pose.pose.orientation), 2.0 * M_PI); };
  driveUntil(0.0, std::copysign(0.3, error()), [&] { return std::abs(error()) < 0.1; });
  ASSERT_TRUE(waitUntilStill());
  ASSERT_EQ(contacts_, 0u);

  // The two come on topics of their own: the newest ground truth may be older than the contact.
  driveUntil(0.3, 0.0, [this] { return contacts_ > 0 && isStill(2); });
  const auto held = truth().pose.pose;
  const auto counted = odometries_.back().pose.pose;
  const double begin = time();
  driveUntil(0.3, 0.0, [&] { return time() > begin + 1.0; });
  EXPECT_EQ(contacts_, 1u);
  EXPECT_LE(distance(held, truth().pose.pose), 0.3 * 0.005) << "a held robot does not move, but for a step";
  EXPECT_GT(distance(counted, odometries_.back().pose.pose), 0.2) << "but its wheels do";
  // A step is 5 ms; one at 0.3 m/s is all that can be missing.
  EXPECT_GE(gap(truth().pose.pose.position), -1e-6);
  EXPECT_LE(gap(truth().pose.pose.position), 0.3 * 0.005 + 1e-6);

  driveUntil(-0.2, 0.0, [&] { return distance(held, truth().pose.pose) > 0.05; });
  EXPECT_EQ(contacts_, 1u);
  driveUntil(0.3, 0.0, [this] { return contacts_ > 1; });
  EXPECT_EQ(contacts_, 2u);
}

const RosProgram program("create2_stub_behaviour", [] {
  const ClockSource clock(ros::param::param("~drive_clock", false));
  return runTests();
});

}  // namespace
}  // namespace lstm_planner::create2_stub_behaviour
