#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "lstm_planner/base/common/random.hpp"
#include "lstm_planner/robot/simulation/simulated_robot.hpp"
#include "lstm_planner/ros/common/conversions.hpp"

namespace lstm_planner {

/// What goes wrong with sensors, transforms and clock. The first ones leave no scan that can be used.
enum class Fault {
  kNoScans,
  kScansOfNan,
  kScansOfZero,
  kScannerCovered,
  kScannerTouched,
  kScannerHalfCovered,
  kScansBackwards,
  kOldScans,
  kNoOdometry,
  kOdometryNan,
  kNoTransforms,
  kOdometryJump,
  kClockSetBack,
  kClockSetForward,
  kNone
};

inline const char* toString(Fault fault) {
  constexpr const char* kNames[] = {"no scans",
                                    "scans of NaN",
                                    "scans of 0",
                                    "a covered scanner",
                                    "a touched scanner",
                                    "a scanner half covered",
                                    "scans that look backwards",
                                    "old scans",
                                    "no odometry",
                                    "odometry of NaN",
                                    "no transforms",
                                    "an odometry that jumped",
                                    "a clock that was set back",
                                    "a clock that was set forward",
                                    "no fault"};
  return kNames[static_cast<std::size_t>(fault)];
}

/// A simulated Create 2 with a Hokuyo on a clock of its own, whose sensors, odometry, transforms and clock fail now and
/// then, at random. What it publishes is in the queues of this process's subscribers when step() returns: nothing waits
/// for the computer's clock.
class FaultyRobot {
 public:
  static constexpr double kPeriod = 0.05;  ///< s, of control, scans and odometry

  /// `mean_pause`: from a fault to the next, s; infinite: none ever comes.
  explicit FaultyRobot(std::uint64_t seed, double mean_pause = 30.0) : random_(seed), mean_pause_(mean_pause) {
    ros::Time::setNow(ros::Time(1e6));
    static_broadcaster_.sendTransform(toMessage(laser_.mount.pose, "base_footprint", "laser", ros::Time::now()));
  }

  /// Somebody puts it into another world; its driver starts to count anew. `world` must outlive its stay.
  void enter(const World& world, const Pose2& start, std::uint64_t seed) {
    SimulatedRobot::Parameters parameters;
    parameters.base.odometry_error = 0.02;
    parameters.scanner = laser_;
    parameters.latency = 0.1;
    robot_ = std::make_unique<SimulatedRobot>(world, parameters, start, seed);
    odometry_offset_ = {};
  }

  /// One period passes at that command; then the sensors publish.
  void step(const Twist2& command) {
    robot_->command(command);
    robot_->advance(kPeriod);
    ros::Time::setNow(ros::Time::now() + ros::Duration(kPeriod));
    breakOrMend();
    publishTransforms();
    publishOdometry();
    publishScan();
  }

  const SimulatedRobot& robot() const { return *robot_; }
  Fault fault() const { return fault_; }
  long faults() const { return faults_; }  ///< so far
  /// Whether the newest scan, if there was one, cannot be used.
  bool isBlind() const { return fault_ < Fault::kNoOdometry; }

  /// What else a test does to each scan; false: it is lost.
  std::function<bool(sensor_msgs::LaserScan*)> pass_scan = [](sensor_msgs::LaserScan*) { return true; };

 private:
  void breakOrMend() {
    if (fault_ != Fault::kNone) {
      fault_left_ -= kPeriod;
      if (fault_left_ <= 0.0) fault_ = Fault::kNone;
    } else if (uniform(random_) < kPeriod / mean_pause_) {
      ++faults_;
      fault_ = static_cast<Fault>(uniformIndex(random_, static_cast<std::size_t>(Fault::kNone)));
      fault_left_ = uniform(random_, 0.1, 6.0);
      if (fault_ == Fault::kOdometryJump) jumpOdometry();
      if (fault_ == Fault::kClockSetBack)
        ros::Time::setNow(ros::Time::now() - ros::Duration(uniform(random_, 0.0, 60.0)));
      if (fault_ == Fault::kClockSetForward) {
        ros::Time::setNow(ros::Time::now() + ros::Duration(uniform(random_, 0.0, 60.0)));
      }
    }
  }

  void jumpOdometry() {
    const Pose2 jump{uniform(random_, -3.0, 3.0), uniform(random_, -3.0, 3.0), uniform(random_, -M_PI, M_PI)};
    odometry_offset_ = compose(odometry_offset_, jump);
  }

  Pose2 odometry() const { return compose(odometry_offset_, robot_->odometry()); }

  /// Localisation knows where the robot is.
  void publishTransforms() {
    if (fault_ == Fault::kNoTransforms) return;
    const Pose2 odometry = this->odometry();
    const Pose2& truth = robot_->truePose();
    const double yaw = truth.yaw - odometry.yaw;
    const Point2 turned = toParentFrame(Pose2{0.0, 0.0, yaw}, Point2{odometry.x, odometry.y});
    const auto message = boost::make_shared<tf2_msgs::TFMessage>();
    const ros::Time now = ros::Time::now();
    message->transforms = {toMessage({truth.x - turned.x, truth.y - turned.y, yaw}, "map", "odom", now),
                           toMessage(odometry, "odom", "base_footprint", now)};
    transforms_.publish(message);
  }

  void publishOdometry() {
    if (fault_ == Fault::kNoOdometry) return;
    const auto message = boost::make_shared<nav_msgs::Odometry>();
    message->header.stamp = ros::Time::now();
    message->header.frame_id = "odom";
    message->child_frame_id = "base_footprint";
    message->pose.pose = toMessage(odometry());
    message->twist.twist.linear.x = robot_->measuredTwist().linear;
    message->twist.twist.angular.z = robot_->measuredTwist().angular;
    if (fault_ == Fault::kOdometryNan) message->pose.pose.position.x = std::nan("");
    odometry_.publish(message);
  }

  void publishScan() {
    robot_->scan(&scan_);
    if (fault_ == Fault::kNoScans) return;
    const auto message = boost::make_shared<sensor_msgs::LaserScan>();
    message->header.stamp = ros::Time::now();
    message->header.frame_id = "laser";
    toMessage(scan_, message.get());
    spoil(message.get());
    if (pass_scan(message.get())) scans_.publish(message);
  }

  void spoil(sensor_msgs::LaserScan* scan) const {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInf = std::numeric_limits<float>::infinity();
    constexpr float kCover = 0.01F;
    auto& ranges = scan->ranges;
    if (fault_ == Fault::kScansOfNan) ranges.assign(ranges.size(), kNan);
    if (fault_ == Fault::kScansOfZero) ranges.assign(ranges.size(), 0.0F);
    if (fault_ == Fault::kScannerCovered) ranges.assign(ranges.size(), kCover);
    if (fault_ == Fault::kScannerTouched) ranges.assign(ranges.size(), -kInf);
    if (fault_ == Fault::kScannerHalfCovered) std::fill(ranges.begin() + ranges.size() / 2, ranges.end(), kCover);
    if (fault_ == Fault::kScansBackwards) scan->angle_min += 3.0F;
    if (fault_ == Fault::kOldScans) scan->header.stamp -= ros::Duration(5.0);
  }

  Random random_;
  double mean_pause_;
  HokuyoParameters laser_;
  std::unique_ptr<SimulatedRobot> robot_;
  Pose2 odometry_offset_;
  LaserScan scan_;
  Fault fault_ = Fault::kNone;
  double fault_left_ = 0.0;  // s
  long faults_ = 0;

  ros::NodeHandle node_;
  tf2_ros::StaticTransformBroadcaster static_broadcaster_;
  ros::Publisher transforms_ = node_.advertise<tf2_msgs::TFMessage>("/tf", 100);
  ros::Publisher odometry_ = node_.advertise<nav_msgs::Odometry>("odom", 100);
  ros::Publisher scans_ = node_.advertise<sensor_msgs::LaserScan>("scan", 100);
};

}  // namespace lstm_planner
