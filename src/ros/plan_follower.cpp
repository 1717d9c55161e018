#include "lstm_planner/ros/plan_follower.hpp"

#include <ros/time.h>

#include <stdexcept>
#include <utility>

#include "lstm_planner/ros/conversions.hpp"

namespace lstm_planner {

namespace {

/// Farther returns do not change a command; not looking at them keeps the controller cheap.
constexpr double kShieldReach = 2.0;

}  // namespace

PlanFollower::PlanFollower(const SteeringControllerParameters& parameters, const std::string& base_frame,
                           const tf2_ros::Buffer& tf)
    : parameters_(parameters),
      frames_(tf),
      sensors_(callbacks_.nodeHandle(), parameters.sensors, frameName(base_frame), tf),
      controller_(parameters.motion),
      shield_(parameters.footprint_radius, parameters.motion.safety_margin, kShieldReach),
      moving_(parameters.motion.moving) {}

void PlanFollower::setPlan(const std::vector<geometry_msgs::PoseStamped>& plan) {
  plan_.clear();
  if (plan.empty()) {
    return;
  }
  std::vector<Pose2> poses;
  poses.reserve(plan.size());
  plan_frame_ = frameName(plan.front().header.frame_id);
  for (const geometry_msgs::PoseStamped& stamped : plan) {
    const Pose2 pose = fromMessage(stamped.pose);
    if (plan_frame_.empty() || frameName(stamped.header.frame_id) != plan_frame_) {
      throw std::invalid_argument("the plan has a pose in frame '" + stamped.header.frame_id + "', expected '" +
                                  plan_frame_ + "' as in its first pose, and not empty");
    }
    if (!isFinite(pose)) {
      throw std::invalid_argument("the plan has a pose that is not finite, or a zero quaternion");
    }
    poses.push_back(pose);
  }
  plan_ = std::move(poses);
  plan_time_ = ros::Time::now();
}

Twist2 PlanFollower::compute() {
  const ros::Time now = ros::Time::now();
  const SensorReading reading = sensors_.read(now);
  checkPlanAge(now);
  planToOdometry(reading.odometry_frame);
  look(reading);
  return controller_.compute(odometry_plan_, reading.scan_pose, reading.twist, shield_,
                             1.0 / parameters_.controller_frequency, moving_.points());
}

bool PlanFollower::goalReached() {
  if (plan_.empty()) {
    return false;
  }
  const SensorReading reading = sensors_.read(ros::Time::now());
  planToOdometry(reading.odometry_frame);
  return controller_.goalReached(reading.newest_pose, odometry_plan_.back());
}

void PlanFollower::checkPlanAge(const ros::Time& now) const {
  // move_base goes on with the last plan when its planner refuses to make another one; this makes it notice.
  const double age = (now - plan_time_).toSec();
  if (parameters_.plan_timeout > 0.0 && age > parameters_.plan_timeout) {
    throw OutdatedPlan("the plan is " + std::to_string(age) + " s old, allowed are " +
                       std::to_string(parameters_.plan_timeout) + " s: the planner does not renew it");
  }
}

void PlanFollower::planToOdometry(const std::string& odometry_frame) {
  odometry_plan_.clear();
  if (plan_.empty()) {
    return;
  }
  const Pose2 odometry_from_plan = frames_.transform(odometry_frame, plan_frame_);
  for (const Pose2& pose : plan_) {
    odometry_plan_.push_back(compose(odometry_from_plan, pose));
  }
}

void PlanFollower::look(const SensorReading& reading) {
  fromMessage(*reading.scan, &scan_);
  toPoints(scan_, reading.mount, {}, &obstacles_);
  shield_.show(obstacles_);
  toProfile(scan_, reading.mount, {}, &profile_);
  if (reading.jumps != jumps_) {
    moving_.reset();
    jumps_ = reading.jumps;
  }
  moving_.show(profile_, reading.scan_pose, reading.scan->header.stamp.toSec());
}

}  // namespace lstm_planner
