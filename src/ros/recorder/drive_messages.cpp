#include "lstm_planner/ros/recorder/drive_messages.hpp"

#include <actionlib_msgs/GoalStatus.h>
#include <tf2/exceptions.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "lstm_planner/drive/perception/message_age.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/common/goal_listener.hpp"

namespace lstm_planner {

namespace {

constexpr double kForwarded = 2.0;  // s within which a goal that comes again from elsewhere was passed on
constexpr double kOldest = 2.0;     // s that a goal may be on its way; an older stamp says when it was thought of
constexpr double kAhead = 0.5;      // s by which the clocks of two computers may differ

/// Goals are made by people and scripts: the stamp is often missing, or of long ago, because tf takes the newest
/// transform then, or that of another computer's clock.
double recentStampOr(const ros::Time& stamp, const ros::Time& received) {
  const double age = received.toSec() - stamp.toSec();  // ros::Duration throws for more than 68 years
  return age <= kOldest && age >= -kAhead ? stamp.toSec() : received.toSec();
}

}  // namespace

DriveMessages::DriveMessages(const tf2::BufferCore& tf, const std::string& base_frame,
                             const std::optional<SensorMount>& mount, const RecorderParameters& parameters,
                             StepSink* sink)
    : tf_(tf),
      mounts_(tf, frameName(base_frame)),
      given_mount_(mount),
      recorder_(parameters, sink, [this](const std::string& frame, double stamp) { return locate(frame, stamp); }) {}

void DriveMessages::hear(const sensor_msgs::LaserScan& scan, const ros::Time& received) {
  ScanHeard heard;
  heard.stamp = stampOr(scan.header.stamp, received).toSec();
  heard.frame = frameName(scan.header.frame_id);
  fromMessage(scan, &heard.scan);
  heard.scan.stamp = heard.stamp;
  // Only odometry says in which frame the robot moves, and so where the scanner sits in it.
  if (!odometry_heard_) return recorder_.reject(Rejection::kNoOdometry, "no odometry has been received yet");
  const SensorMount* mount = mountOf(heard.frame);
  if (mount == nullptr) return;
  heard.mount = *mount;
  DriveEvent event = std::move(heard);
  if (isUsable(event)) recorder_.add(std::move(event));
}

void DriveMessages::hear(const nav_msgs::Odometry& odometry, const ros::Time& received) {
  const geometry_msgs::Twist& twist = odometry.twist.twist;
  const OdometryHeard heard{stampOr(odometry.header.stamp, received).toSec(),
                            fromMessage(odometry.pose.pose),
                            {twist.linear.x, twist.angular.z}};
  if (!isUsable(heard)) return;
  odometry_heard_ = true;
  odometry_frame_ = frameName(odometry.header.frame_id);
  mounts_.setBaseFrame(robotFrameOf(odometry));
  recorder_.add(heard);
}

void DriveMessages::hear(const move_base_msgs::MoveBaseActionGoal& goal, const std::string& source,
                         const ros::Time& received) {
  hearGoal(goal.goal.target_pose, source, received);
  action_goal_ = goal.goal_id;
  if (action_goal_.stamp.isZero()) action_goal_.stamp = goal.header.stamp;
}

void DriveMessages::hear(const actionlib_msgs::GoalID& cancel, const ros::Time& received) {
  const bool all = cancel.id.empty() && cancel.stamp.isZero();
  const bool this_one = !cancel.id.empty() && cancel.id == action_goal_.id;
  const bool up_to_then = !cancel.stamp.isZero() && !action_goal_.stamp.isZero() && action_goal_.stamp <= cancel.stamp;
  if (all || this_one || up_to_then) hearEnd(received);
}

void DriveMessages::hear(const move_base_msgs::MoveBaseActionResult& result, const ros::Time& received) {
  const bool succeeded = result.status.status == actionlib_msgs::GoalStatus::SUCCEEDED;
  if (!succeeded && isOurs(result.status.goal_id)) hearEnd(ros::Time(recentStampOr(result.header.stamp, received)));
}

/// A goal that takes the place of another ends that one afterwards.
bool DriveMessages::isOurs(const actionlib_msgs::GoalID& ended) const {
  if (!action_goal_.id.empty()) return ended.id == action_goal_.id;
  // move_base passes on rviz's goals without an id, and its action makes one that nobody hears of before the result.
  return !action_goal_.stamp.isZero() && ended.stamp >= action_goal_.stamp;
}

void DriveMessages::hearGoal(const geometry_msgs::PoseStamped& goal, const std::string& source,
                             const ros::Time& received) {
  geometry_msgs::PoseStamped message = goal;
  // Where only the place matters people leave out the heading.
  if (isZero(message.pose.orientation)) message.pose.orientation.w = 1.0;
  GoalHeard heard;
  heard.stamp = recentStampOr(goal.header.stamp, received);
  heard.source = source;
  try {
    heard.goal = goalFromMessage(message);
  } catch (const std::invalid_argument& error) {
    const bool no_frame = frameName(goal.header.frame_id).empty();
    return recorder_.reject(no_frame ? Rejection::kNoTransform : Rejection::kNotFinite, error.what());
  }
  if (!isUsable(heard)) return;
  const bool forwarded = last_goal_ && last_goal_->source != source && sameGoal(last_goal_->goal, heard.goal) &&
                         std::abs(heard.stamp - last_goal_->stamp) <= kForwarded;
  last_goal_ = LastGoal{heard.goal, source, heard.stamp};
  if (forwarded) return;
  action_goal_ = {};
  // Such as "a metre ahead": move_base, too, takes it for the place that this was then.
  const std::optional<Pose2> frame =
      movesWithRobot(heard.goal.frame) ? locate(heard.goal.frame, heard.stamp) : std::nullopt;
  if (frame) heard.goal = {odometry_frame_, compose(*frame, heard.goal.pose)};
  heard.stamp = inOrder(heard.stamp);
  recorder_.add(heard);
}

void DriveMessages::hearEnd(const ros::Time& stamp) {
  last_goal_.reset();
  action_goal_ = {};
  recorder_.add(GoalGivenUp{inOrder(stamp.toSec())});
}

double DriveMessages::inOrder(double stamp) {
  // Older ones are from before the clock was set back.
  const bool is_recent = last_word_ - stamp <= kOldest + kAhead;
  last_word_ = stamp <= last_word_ && is_recent ? std::nextafter(last_word_, HUGE_VAL) : stamp;
  return last_word_;
}

bool DriveMessages::movesWithRobot(const std::string& frame) const {
  constexpr int kMostFrames = 1000;  // as tf itself: transforms may make a circle
  std::string child = frame;
  std::string parent;
  for (int i = 0; i < kMostFrames && tf_._getParent(child, ros::Time(0), parent); ++i) {
    if (parent == odometry_frame_) return true;
    child = parent;
  }
  return false;
}

std::optional<Pose2> DriveMessages::locate(const std::string& frame, double stamp) const {
  if (frame == odometry_frame_) return Pose2();
  try {
    const ros::Time time(stamp);
    const bool known_then = tf_.canTransform(odometry_frame_, frame, time);
    const Pose2 pose =
        fromMessage(tf_.lookupTransform(odometry_frame_, frame, known_then ? time : ros::Time(0)).transform);
    if (lstm_planner::isFinite(pose)) return pose;
  } catch (const std::exception&) {
    // tf2's exceptions for frames it does not know, and ros::Time's for stamps it cannot hold
  }
  return std::nullopt;
}

const SensorMount* DriveMessages::mountOf(const std::string& frame) {
  if (given_mount_) return &*given_mount_;
  try {
    return &mounts_.at(frame);
  } catch (const SensorError& error) {
    recorder_.reject(Rejection::kNoTransform, error.what());
    return nullptr;
  }
}

bool DriveMessages::isUsable(const DriveEvent& event) {
  const std::string flaw = flawOf(event);
  if (!flaw.empty()) recorder_.reject(Rejection::kNotFinite, flaw);
  return flaw.empty();
}

}  // namespace lstm_planner
