#include "ros/common/sensor_listener.hpp"

#include <ros/console.h>

#include <cmath>

#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/common/message_age.hpp"

namespace lstm_planner {

namespace {

constexpr int kScanQueue = 3;        // the newest counts, those before it tell the scanner's period
constexpr int kOdometryQueue = 100;  // a tenth of a second of the fastest

/// When it was received stands in where a driver does not stamp its messages and leaves zero there.
ros::Time stampOr(const ros::Time& stamp, const ros::Time& received) { return stamp.isZero() ? received : stamp; }

/// `age`: by the stamp; `silence`: since it was received; s.
void checkAge(double age, double silence, double timeout, const std::string& topic, const std::string& parameter) {
  std::string problem = ageProblem(age, timeout, parameter);
  if (problem.empty()) return;
  if (age > timeout && silence <= timeout) {
    problem += ", although it has just come: the network is slow, or the clocks differ (NTP)";
  }
  throw SensorError("the newest message on " + topic + " is " + problem);
}

}  // namespace

SensorListener::SensorListener(MessageQueue* messages, const SensorParameters& parameters,
                               const std::string& base_frame, const tf2_ros::Buffer& tf)
    : messages_(*messages), parameters_(parameters), mounts_(tf, base_frame), history_(parameters.max_speed) {
  // Without this, TCP holds a scan back until the one before is acknowledged: up to 40 ms.
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  ros::NodeHandle node_handle = messages_.nodeHandle();
  scan_subscriber_ = node_handle.subscribe(parameters.scan_topic, kScanQueue, &SensorListener::onScan, this, hints);
  odometry_subscriber_ =
      node_handle.subscribe(parameters.odom_topic, kOdometryQueue, &SensorListener::onOdometry, this, hints);
}

void SensorListener::onScan(const ros::MessageEvent<sensor_msgs::LaserScan const>& event) {
  const std::lock_guard<std::mutex> lock(mutex_);
  scan_ = event.getConstMessage();
  scan_received_ = event.getReceiptTime();
  scan_stamp_ = stampOr(scan_->header.stamp, scan_received_);
  fromMessage(*scan_, &laser_scan_);
  scan_period_.note(scan_stamp_.toSec());
  silence_.show(laser_scan_, parameters_.scan_rules, scan_stamp_.toSec(),
                history_.empty() ? Pose2() : history_.newest().pose);
}

void SensorListener::onOdometry(const ros::MessageEvent<nav_msgs::Odometry const>& event) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const nav_msgs::Odometry::ConstPtr odometry = event.getConstMessage();
  odometry_received_ = event.getReceiptTime();
  odometry_stamp_ = stampOr(odometry->header.stamp, odometry_received_);
  odometry_period_.note(odometry_stamp_.toSec());
  const geometry_msgs::Twist& twist = odometry->twist.twist;
  const OdometryHistory::Entry entry{
      odometry_stamp_.toSec(), fromMessage(odometry->pose.pose), {twist.linear.x, twist.angular.z}};
  odometry_is_finite_ = isFinite(entry.pose) && std::isfinite(entry.twist.linear) && std::isfinite(entry.twist.angular);
  if (frameName(odometry->header.frame_id) != odometry_frame_) {
    history_.restart();
    odometry_frame_ = frameName(odometry->header.frame_id);
  }
  mounts_.setBaseFrame(frameName(odometry->child_frame_id));
  if (odometry_is_finite_) {
    history_.add(entry);
  }
}

SensorReading SensorListener::read(const ros::Time& now) {
  messages_.handOut();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!scan_) {
    throw SensorError("no scan has been received on " + scan_subscriber_.getTopic());
  }
  if (odometry_stamp_.isZero()) {
    throw SensorError("no odometry has been received on " + odometry_subscriber_.getTopic());
  }
  sayTimeoutsOnce();
  checkAges(now);
  if (silence_.isCovered()) {
    throw SensorError("the scanner counts as covered: on " + scan_subscriber_.getTopic() +
                      " no beam has had a return since a scan in which " +
                      std::to_string(std::lround(100.0 * silence_.shareBefore())) + " % of them had one");
  }
  if (!odometry_is_finite_ || history_.empty()) {
    throw SensorError("the odometry on " + odometry_subscriber_.getTopic() +
                      " has a pose or twist that is not finite, or a zero quaternion");
  }
  if (odometry_frame_.empty()) {
    throw SensorError("the odometry on " + odometry_subscriber_.getTopic() + " names no frame");
  }
  SensorReading reading;
  reading.scan = scan_;
  reading.scan_stamp = scan_stamp_.toSec();
  reading.scan_period = scan_period_.period();
  reading.mount = mountOf(frameName(scan_->header.frame_id));
  reading.odometry_frame = odometry_frame_;
  reading.scan_pose = history_.poseAt(scan_stamp_.toSec());
  reading.newest_pose = history_.newest().pose;
  reading.twist = history_.newest().twist;
  reading.jumps = history_.jumps();
  return reading;
}

SensorHealth SensorListener::scanHealth(const ros::Time& now) {
  messages_.handOut();
  const std::lock_guard<std::mutex> lock(mutex_);
  return {scan_subscriber_.getTopic(), secondsBetween(scan_stamp_, now), scan_period_.period(), scanTimeout(),
          scan_ != nullptr};
}

SensorHealth SensorListener::odometryHealth(const ros::Time& now) {
  messages_.handOut();
  const std::lock_guard<std::mutex> lock(mutex_);
  return {odometry_subscriber_.getTopic(), secondsBetween(odometry_stamp_, now), odometry_period_.period(),
          odometryTimeout(), !odometry_stamp_.isZero()};
}

double SensorListener::scanTimeout() const {
  return timeoutFor(parameters_.scan_timeout, scan_period_.period(), parameters_.least_scan_timeout);
}

double SensorListener::odometryTimeout() const {
  return timeoutFor(parameters_.odom_timeout, odometry_period_.period(), parameters_.least_odom_timeout);
}

void SensorListener::checkAges(const ros::Time& now) const {
  checkAge(secondsBetween(scan_stamp_, now), secondsBetween(scan_received_, now), scanTimeout(),
           scan_subscriber_.getTopic(), "scan_timeout");
  checkAge(secondsBetween(odometry_stamp_, now), secondsBetween(odometry_received_, now), odometryTimeout(),
           odometry_subscriber_.getTopic(), "odom_timeout");
}

void SensorListener::sayTimeoutsOnce() {
  if (timeouts_are_said_ || scan_period_.period() == 0.0 || odometry_period_.period() == 0.0) return;
  timeouts_are_said_ = true;
  ROS_INFO("a scan comes every %.3f s and is used for %.2f s, an odometry every %.3f s for %.2f s",
           scan_period_.period(), scanTimeout(), odometry_period_.period(), odometryTimeout());
}

const SensorMount& SensorListener::mountOf(const std::string& frame) {
  if (frame.empty()) throw SensorError("the scan on " + scan_subscriber_.getTopic() + " names no frame");
  try {
    return mounts_.at(frame);
  } catch (const MountUnknown& error) {
    throw SensorError(error.what());
  }
}

}  // namespace lstm_planner
