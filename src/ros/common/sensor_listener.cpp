#include "ros/common/sensor_listener.hpp"

#include <ros/console.h>

#include <algorithm>
#include <cmath>

#include "lstm_planner/drive/perception/deskew.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/common/timing.hpp"

namespace lstm_planner {

namespace {

constexpr int kScanQueue = 3;         // the newest counts, those before it tell the scanner's period
constexpr int kOdometryQueue = 100;   // a tenth of a second of the fastest
constexpr double kAngleSlack = 0.02;  // rad

void sayTwoPublishers(const std::string& topic, const std::string& publisher, double now, PublisherWatch* watch) {
  if (!watch->note(publisher, now)) return;
  ROS_WARN("two nodes publish on %s, %s and %s: their messages are taken for those of one, which then seems to jump",
           topic.c_str(), watch->newest().c_str(), watch->other().c_str());
}

}  // namespace

void perceive(const SensorReading& reading, const Pose2& from_odometry, const ScanRules& rules, double range_cap,
              Situation* situation) {
  const ScanReading& first = reading.first;
  perceive(first.scan, first.mount, rules, range_cap, situation);
  situation->pose = compose(from_odometry, first.pose);
  situation->time = first.stamp;
  if (const auto& second = reading.second) {
    perceiveSecond({second->scan, second->mount, compose(from_odometry, second->pose), second->stamp}, rules,
                   situation);
  }
}

SensorListener::SensorListener(MessageQueue* messages, const SensorParameters& parameters,
                               const std::string& base_frame, const tf2_ros::Buffer& tf)
    : messages_(*messages),
      parameters_(parameters),
      base_frame_(base_frame),
      odometry_topic_(messages_.nodeHandle().resolveName(parameters.odom_topic)),
      mounts_(tf, base_frame),
      odometry_base_(tf, base_frame),
      history_(parameters.max_speed),
      first_(watchFor(parameters.scan_topic)) {
  const bool has_second = !parameters.second_scan_topic.empty();
  if (has_second) second_.emplace(watchFor(parameters.second_scan_topic));
  // Without this, TCP holds a scan back until the one before is acknowledged: up to 40 ms.
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  ros::NodeHandle node_handle = messages_.nodeHandle();
  scan_subscriber_ = node_handle.subscribe(parameters.scan_topic, kScanQueue, &SensorListener::onScan, this, hints);
  if (has_second) {
    second_scan_subscriber_ =
        node_handle.subscribe(parameters.second_scan_topic, kScanQueue, &SensorListener::onSecondScan, this, hints);
  }
  odometry_subscriber_ =
      node_handle.subscribe(parameters.odom_topic, kOdometryQueue, &SensorListener::onOdometry, this, hints);
}

ScannerWatch SensorListener::watchFor(const std::string& topic) const {
  return {messages_.nodeHandle().resolveName(topic), parameters_.scan_timeout, parameters_.least_scan_timeout};
}

void SensorListener::hear(const ScanEvent& event, Scanner* scanner) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const sensor_msgs::LaserScan& message = *event.getConstMessage();
  fromMessage(message, &scanner->scan);
  scanner->frame = frameName(message.header.frame_id);
  const ros::Time received = event.getReceiptTime();
  scanner->watch.hear(scanner->scan, parameters_.scan_rules, stampOr(message.header.stamp, received).toSec(),
                      received.toSec(), history_.empty() ? Pose2() : history_.newest().pose);
  sayContradictions(message, scanner->watch.topic());
  sayTwoPublishers(scanner->watch.topic(), event.getPublisherName(), received.toSec(), &scanner->publishers);
}

void SensorListener::onOdometry(const ros::MessageEvent<nav_msgs::Odometry const>& event) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const nav_msgs::Odometry::ConstPtr odometry = event.getConstMessage();
  odometry_received_ = event.getReceiptTime();
  odometry_stamp_ = stampOr(odometry->header.stamp, odometry_received_);
  odometry_period_.note(odometry_stamp_.toSec());
  const geometry_msgs::Twist& twist = odometry->twist.twist;
  const long jumps = history_.jumps();
  const bool base_moved = odometry_base_.setFrame(robotFrameOf(*odometry));
  const OdometryHistory::Entry entry{odometry_stamp_.toSec(), odometry_base_.poseOf(fromMessage(odometry->pose.pose)),
                                     odometry_base_.twistOf({twist.linear.x, twist.angular.z}, twist.linear.y)};
  odometry_is_finite_ = isFinite(entry.pose) && std::isfinite(entry.twist.linear) && std::isfinite(entry.twist.angular);
  if (base_moved || frameName(odometry->header.frame_id) != odometry_frame_) {
    history_.restart();
    odometry_frame_ = frameName(odometry->header.frame_id);
  }
  if (odometry_is_finite_) {
    history_.add(entry);
  }
  if (history_.jumps() != jumps) {
    first_.watch.noteJump(entry.stamp, entry.pose);
    if (second_) second_->watch.noteJump(entry.stamp, entry.pose);
  }
  sayContradictions(*odometry);
  sayTwoPublishers(odometry_topic_, event.getPublisherName(), odometry_received_.toSec(), &odometry_publishers_);
}

void SensorListener::sayContradictions(const sensor_msgs::LaserScan& scan, const std::string& topic) const {
  const double last = scan.angle_min + (static_cast<double>(scan.ranges.size()) - 1.0) * scan.angle_increment;
  if (!(std::abs(last - scan.angle_max) > std::max(kAngleSlack, 2.0 * std::abs(scan.angle_increment)))) return;
  ROS_WARN_ONCE(
      "the scans on %s contradict themselves: %zu beams from angle_min = %.4f rad, one every angle_increment = %.6f "
      "rad, end at %.4f rad, but angle_max is %.4f rad. angle_max is not used; are the others right?",
      topic.c_str(), scan.ranges.size(), static_cast<double>(scan.angle_min), static_cast<double>(scan.angle_increment),
      last, static_cast<double>(scan.angle_max));
}

void SensorListener::sayContradictions(const nav_msgs::Odometry& odometry) const {
  const std::string& topic = odometry_topic_;
  if (!odometry.child_frame_id.empty() && robotFrameOf(odometry).empty()) {
    ROS_WARN_ONCE(
        "the odometry on %s contradicts itself: %s is its frame_id and its child_frame_id. The costmap's "
        "robot_base_frame is taken for the robot's frame",
        topic.c_str(), odometry_frame_.c_str());
  }
  const auto& contradiction = history_.twistWatch().contradiction();
  if (!contradiction) return;
  const auto& [said, shown] = *contradiction;
  ROS_WARN_ONCE(
      "the odometry on %s contradicts itself: its twist says %.3f m/s and %.3f rad/s, its poses move by %.3f m/s and "
      "%.3f rad/s. From now on the speed is taken from the poses. See nav_msgs/Odometry and REP 103: the twist is the "
      "robot's, in child_frame_id (x ahead), in m/s and rad/s",
      topic.c_str(), said.linear, said.angular, shown.linear, shown.angular);
}

SensorReading SensorListener::read(const ros::Time& now) {
  messages_.handOut();
  const std::lock_guard<std::mutex> lock(mutex_);
  sayTimeoutsOnce();
  first_.watch.check(now.toSec());
  if (second_) second_->watch.check(now.toSec());
  checkOdometry(now);
  SensorReading reading;
  reading.first = readingOf(&first_);
  reading.scan_period = first_.watch.period();
  if (second_) {
    reading.second = readingOf(&*second_);
    reading.scan_period = std::max(reading.scan_period, second_->watch.period());
  }
  reading.odometry_frame = odometry_frame_;
  reading.odometry_stamp = history_.newest().stamp;
  reading.newest_pose = history_.poseAt(std::max(reading.odometry_stamp, reading.first.stamp));
  reading.twist = history_.twist();
  reading.jumps = history_.jumps();
  return reading;
}

ScanReading SensorListener::readingOf(Scanner* scanner) {
  const double stamp = scanner->watch.stamp();
  ScanReading reading{scanner->scan, stamp, mountOf(*scanner), history_.poseAt(stamp)};
  reading.scan.stamp = stamp;
  const ScanRules rules = rulesFor(reading, scanner);
  deskew(
      reading.mount, rules, [this](double time) { return history_.poseAt(time); }, &reading.scan);
  return reading;
}

/// With the times of the beams as they were found, where nobody has set them. `reading`: as the driver sent it.
ScanRules SensorListener::rulesFor(const ScanReading& reading, Scanner* scanner) const {
  ScanRules rules = parameters_.scan_rules;
  BeamTimesWatch& watch = scanner->beam_times;
  if (rules.beam_times) return rules;
  const bool was_found = watch.found().has_value();
  watch.show(reading.scan, reading.mount, rules, scanner->watch.period(),
             [this](double time) { return history_.poseAt(time); });
  rules.beam_times = watch.found();
  if (rules.beam_times && !was_found) {
    ROS_INFO(
        "by comparison of scans on %s their first beam is measured %.3f s after the stamp, the last one %.3f s: from "
        "now on scans are corrected for the robot's motion by these beam_times",
        scanner->watch.topic().c_str(), rules.beam_times->first, rules.beam_times->last);
  }
  return rules;
}

std::optional<Pose2> SensorListener::newestPose() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (history_.empty()) return std::nullopt;
  return history_.newest().pose;
}

SensorHealth SensorListener::scanHealth(const ros::Time& now) { return healthOf(first_, now); }

SensorHealth SensorListener::secondScanHealth(const ros::Time& now) { return healthOf(second_.value(), now); }

SensorHealth SensorListener::healthOf(const Scanner& scanner, const ros::Time& now) {
  messages_.handOut();
  const std::lock_guard<std::mutex> lock(mutex_);
  const ScannerWatch& watch = scanner.watch;
  return {watch.topic(),
          now.toSec() - watch.stamp(),
          watch.period(),
          watch.timeout(),
          watch.ageProblem(now.toSec()),
          watch.isHeard(),
          false};
}

SensorHealth SensorListener::odometryHealth(const ros::Time& now) {
  messages_.handOut();
  const std::lock_guard<std::mutex> lock(mutex_);
  return {odometry_topic_,
          secondsBetween(odometry_stamp_, now),
          odometry_period_.period(),
          odometryTimeout(),
          odometryProblem(now),
          !odometry_stamp_.isZero(),
          history_.twistWatch().contradiction().has_value()};
}

double SensorListener::odometryTimeout() const {
  return timeoutFor(parameters_.odom_timeout, odometry_period_.period(), parameters_.least_odom_timeout);
}

std::string SensorListener::odometryProblem(const ros::Time& now) const {
  return messageProblem(secondsBetween(odometry_stamp_, now), secondsBetween(odometry_received_, now),
                        odometryTimeout(), odometry_topic_, "odom_timeout");
}

void SensorListener::checkOdometry(const ros::Time& now) const {
  const std::string& topic = odometry_topic_;
  if (odometry_stamp_.isZero()) {
    throw SensorError("no odometry has been received on " + topic);
  }
  if (const std::string problem = odometryProblem(now); !problem.empty()) throw SensorError(problem);
  if (!odometry_base_.problem().empty()) {
    throw SensorError("the odometry on " + topic + " cannot be used: its child_frame_id " + odometry_base_.problem());
  }
  if (!odometry_is_finite_ || history_.empty()) {
    throw SensorError("the odometry on " + topic + " has a pose or twist that is not finite, or a zero quaternion");
  }
  if (odometry_frame_.empty()) {
    throw SensorError("the odometry on " + topic + " names no frame");
  }
}

void SensorListener::sayTimeoutsOnce() {
  const bool is_second_measured = !second_ || second_->watch.period() > 0.0;
  const bool is_measured = first_.watch.period() > 0.0 && is_second_measured && odometry_period_.period() > 0.0;
  if (timeouts_are_said_ || !is_measured) return;
  timeouts_are_said_ = true;
  ROS_INFO("a scan comes every %.3f s and is used for %.2f s, an odometry every %.3f s for %.2f s",
           first_.watch.period(), first_.watch.timeout(), odometry_period_.period(), odometryTimeout());
  if (!second_) return;
  ROS_INFO("a scan of the second scanner comes every %.3f s and is used for %.2f s", second_->watch.period(),
           second_->watch.timeout());
}

const SensorMount& SensorListener::mountOf(const Scanner& scanner) {
  if (scanner.frame.empty()) throw SensorError("the scan on " + scanner.watch.topic() + " names no frame");
  const SensorMount& mount = mounts_.at(scanner.frame);
  if (!odometry_base_.isKnown()) {
    ROS_WARN_ONCE("tf does not know the frame that the odometry on %s is of (child_frame_id): %s is taken",
                  odometry_topic_.c_str(), base_frame_.c_str());
  }
  return mount;
}

}  // namespace lstm_planner
