#include "ros/controller/plan_follower.hpp"

#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/time.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/drive/collision/returns_inside.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "ros/common/timing.hpp"

namespace lstm_planner {

namespace {

/// Farther returns do not change a command of a slow robot; not looking at them keeps the controller cheap.
constexpr double kLeastReach = 2.0;  // m

constexpr double kNearMark = 0.3;  // m; farther obstacles of the costmap hardly block

/// m, of what changes a command: as far as the robot needs to stop behind a slow scanner, and to steer.
double reachOf(const SteeringControllerParameters& parameters) {
  constexpr double kSlowestReaction = 1.0;  // s
  const MotionParameters& motion = parameters.motion;
  const double stopping =
      motion.max_linear * kSlowestReaction + motion.max_linear * motion.max_linear / (2.0 * motion.linear_acceleration);
  return std::max(kLeastReach, stopping + motion.lookahead + motion.slow_gap +
                                   2.0 * (footprintOf(parameters).circumscribedRadius() + motion.safety_margin));
}

}  // namespace

PlanFollower::PlanFollower(const SteeringControllerParameters& parameters, const std::string& base_frame,
                           const tf2_ros::Buffer& tf, costmap_2d::Costmap2DROS* costmap)
    : parameters_(parameters),
      reach_(reachOf(parameters)),
      frames_(tf, parameters.sensors.tf_timeout),
      sensors_(&messages_, parameters.sensors, frameName(base_frame), tf),
      tf_check_(frames_, frameName(base_frame), parameters.sensors.odom_topic),
      costmap_(parameters.use_costmap ? costmap : nullptr, reach_),
      tracker_(parameters.motion),
      shield_(footprintOf(parameters), parameters.motion.safety_margin, reach_),
      out_of_view_(shield_.footprint()) {}

void PlanFollower::change(const SteeringControllerParameters& parameters) {
  if (reachOf(parameters) > reach_) {
    throw std::invalid_argument("that needs a restart: the controller would have to check obstacles within " +
                                numberText(reachOf(parameters)) + " m, and it checks them within " +
                                numberText(reach_) + " m");
  }
  tracker_.change(parameters.motion);
  shield_ = Shield(footprintOf(parameters), parameters.motion.safety_margin, reach_);
  parameters_ = parameters;
}

void PlanFollower::setPlan(const std::vector<geometry_msgs::PoseStamped>& plan) {
  plan_.clear();
  if (plan.empty()) {
    return;
  }
  plan_frame_ = frameName(plan.front().header.frame_id);
  std::vector<Pose2> poses;
  for (const geometry_msgs::PoseStamped& stamped : plan) {
    Pose2 pose = fromMessage(stamped.pose);
    // Of the headings only the last one counts: a planner may leave out the others.
    if (isZero(stamped.pose.orientation)) pose.yaw = 0.0;
    if (plan_frame_.empty() || frameName(stamped.header.frame_id) != plan_frame_) {
      throw std::invalid_argument("the plan has a pose in frame '" + stamped.header.frame_id + "', expected '" +
                                  plan_frame_ + "' as in its first pose, and not empty");
    }
    if (!isFinite(pose)) {
      throw std::invalid_argument("the plan has a pose that is not finite");
    }
    poses.push_back(pose);
  }
  if (isZero(plan.back().pose.orientation) && parameters_.motion.heading_tolerance < M_PI) {
    ROS_WARN_THROTTLE(kLogPeriod, "the orientation of the plan's last pose is a zero quaternion, taken as heading 0");
  }
  plan_ = std::move(poses);
  plan_time_ = ros::Time::now();
  plan_jumps_.reset();
}

MotionCommand PlanFollower::compute() {
  const ros::Time now = ros::Time::now();
  const SensorReading reading = sensors_.read(now);
  tf_check_.note(reading, now);
  checkPlanAge(now);
  const Pose2 odometry_from_plan = odometryFromPlan(reading.odometry_frame, now);
  if (!plan_jumps_) plan_jumps_ = reading.jumps;
  if (*plan_jumps_ != reading.jumps) throw OutdatedPlan("the odometry has jumped since the plan was made");
  std::vector<Pose2> odometry_plan;
  for (const Pose2& pose : plan_) odometry_plan.push_back(compose(odometry_from_plan, pose));
  perceive(reading, now);
  asked_.note(now.toSec());  // a busy computer may ask more seldom than controller_frequency says
  const double period = std::max(1.0 / parameters_.controller_frequency, asked_.period());
  const double oldest = reading.second ? std::min(reading.first.stamp, reading.second->stamp) : reading.first.stamp;
  tracker_.expectReactionTime(std::max(0.0, now.toSec() - reading.odometry_stamp),
                              std::max(reading.scan_period, now.toSec() - oldest), period);
  speed_ = std::abs(reading.twist.linear);
  MotionCommand command = tracker_.compute({odometry_plan, reading.newest_pose, reading.twist, shield_, period}, seen_,
                                           std::max(0.0, reading.odometry_stamp - reading.first.stamp));
  sayDelay();
  idle_.note(reading.newest_pose, now.toSec(), {command.linear, command.angular});
  if (command.stop == StopReason::kNone && idle_.idle() > 0.0) command.stop = StopReason::kIdle;
  return command;
}

void PlanFollower::sayDelay() {
  if (tracker_.delayOfBase() <= told_delay_) return;
  told_delay_ = tracker_.delayOfBase();
  ROS_WARN(
      "the robot turns %.2f s after it is told to, longer than reaction_time = %.2f s allows for: from now on the "
      "controller turns and brakes for this delay. Is there a velocity smoother, a mux or a slow link before the base? "
      "Add its delay to reaction_time",
      told_delay_, parameters_.motion.reaction_time);
}

std::string PlanFollower::whyIdle() const {
  if (idle_.idle() == 0.0) return "";
  const ros::NodeHandle node;
  return "for " + fixedText(idle_.idle(), 0) + " s the commands on " + node.resolveName("cmd_vel") +
         " were to move, and by the odometry on " + node.resolveName(parameters_.sensors.odom_topic) + " it did not";
}

std::string PlanFollower::whatBlocks(const std::string& why) const {
  const std::string inside = returnsInside(seen_.obstacles, shield_.footprint());
  if (!inside.empty()) return why.empty() ? inside : why + "; " + inside;
  const auto nearest = [this](const std::vector<Point2>& points) {
    double gap = reach_;
    for (const Point2& point : points) gap = std::min(gap, shield_.footprint().distanceTo(point));
    return gap;
  };
  const double marked = nearest(marked_);
  if (marked >= nearest(known_) || marked > kNearMark) return why;
  const std::string text =
      "an obstacle of the costmap, which the scan does not show, is " + fixedText(marked, 2) + " m away";
  return why.empty() ? text : why + "; " + text;
}

bool PlanFollower::goalReached() {
  if (plan_.empty()) {
    return false;
  }
  const ros::Time now = ros::Time::now();
  const SensorReading reading = sensors_.read(now);
  if (plan_jumps_ && *plan_jumps_ != reading.jumps) return false;
  const Pose2 goal = compose(odometryFromPlan(reading.odometry_frame, now), plan_.back());
  return tracker_.goalReached(reading.newest_pose, goal);
}

void PlanFollower::checkPlanAge(const ros::Time& now) const {
  // move_base goes on with the last plan when its planner refuses to make another one; this makes it notice.
  if (parameters_.plan_timeout <= 0.0) return;
  const double age = secondsBetween(plan_time_, now);
  if (age < 0.0) {
    throw OutdatedPlan("the clock was set back by at least " + fixedText(-age, 3) +
                       " s since the plan was made: the age of the plan is not known");
  }
  if (age > parameters_.plan_timeout) {
    throw OutdatedPlan("the plan is " + fixedText(age, 3) + " s old, allowed are plan_timeout = " +
                       numberText(parameters_.plan_timeout) + " s: the planner does not renew it");
  }
}

Pose2 PlanFollower::odometryFromPlan(const std::string& odometry_frame, const ros::Time& now) const {
  return plan_.empty() ? Pose2() : frames_.transform(odometry_frame, plan_frame_, now);
}

void PlanFollower::perceive(const SensorReading& reading, const ros::Time& now) {
  lstm_planner::perceive(reading, {}, parameters_.sensors.scan_rules, kLeastReach, &seen_);
  const bool jumped = reading.jumps != jumps_;
  jumps_ = reading.jumps;
  if (jumped) {
    tracker_.forget();
    out_of_view_.forget();
  }
  known_ = seen_.obstacles;
  if (!shield_.footprint().isCircle()) {
    out_of_view_.show(seen_);
    known_.insert(known_.end(), out_of_view_.points().begin(), out_of_view_.points().end());
  }
  // A scan may be old; the robot may have braked since, so that its speed does not tell how far it has come.
  known_ = toParentFrame(compose(inverse(reading.newest_pose), seen_.pose), std::move(known_));
  shield_.show(known_);
  if (costmap_.isUsed()) {
    const Pose2 costmap_from_odometry = frames_.transform(costmap_.frame(), reading.odometry_frame, now);
    // Cells around what is known to the centimetre would only make it larger.
    marked_ = costmap_.read(compose(costmap_from_odometry, reading.newest_pose), known_);
    shield_.add(marked_);
  }
}

}  // namespace lstm_planner
