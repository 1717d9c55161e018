#include "ros/planner/plan_maker.hpp"

#include <nav_msgs/Path.h>
#include <ros/console.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/drive/collision/returns_inside.hpp"
#include "lstm_planner/drive/motion/elastic_band.hpp"
#include "lstm_planner/ros/common/conversions.hpp"

namespace lstm_planner {

namespace {

/// m; a robot that is farther from the end of its plan has not reached it.
constexpr double kFarthestEnd = 1.0;

/// How long the driven goal may go without a call before another one can take its place, s. Warns if it is never asked
/// for again.
double goalPatience() {
  const double frequency = ros::NodeHandle("~").param("planner_frequency", 0.0);
  if (frequency > 0.0) return std::max(1.0, 3.0 / frequency);
  ROS_WARN(
      "%s/planner_frequency is 0: move_base asks for one plan per goal only. This planner must plan again while the "
      "robot drives; set it to 5",
      ros::this_node::getName().c_str());
  return 5.0;
}

/// move_base_flex does, and has a list of planners.
bool announcesEachPlan() { return ros::NodeHandle("~").hasParam("planners"); }

/// Only a network that leads must be there. `problem`: why it is not.
DrivePolicy policyOf(const GlobalPlannerParameters& parameters, std::string* problem) {
  try {
    return DrivePolicy::fromFile(resolvedPath(parameters.model));
  } catch (const std::exception& error) {
    if (parameters.agent.leader == Leader::kNetwork) throw;
    *problem = error.what();
    return noPolicy();
  }
}

}  // namespace

PlanMaker::PlanMaker(const std::string& name, const GlobalPlannerParameters& parameters,
                     const std::string& global_frame, const std::string& base_frame, costmap_2d::Costmap2DROS* costmap)
    : parameters_(parameters),
      global_frame_(frameName(global_frame)),
      agent_(policyOf(parameters, &model_problem_), parameters.agent),
      tf_listener_(&tf_, messages_.nodeHandle()),
      frames_(tf_, parameters.sensors.tf_timeout),
      sensors_(&messages_, parameters.sensors, frameName(base_frame), tf_),
      tf_check_(frames_, frameName(base_frame), parameters.sensors.odom_topic),
      costmap_(parameters.use_costmap ? costmap : nullptr, parameters.agent.shield.reach),
      goals_(messages_.nodeHandle(), messages_.nodeHandle("~")),
      announces_each_plan_(announcesEachPlan()),
      tracker_(goalPatience(), announces_each_plan_),
      markers_(ros::NodeHandle("~/" + name), agent_.policy().description(), parameters.trace_length),
      decisions_(ros::NodeHandle("~/" + name), agent_.policy().description().actions),
      arrival_(ros::NodeHandle("~/" + name)),
      plan_publisher_(ros::NodeHandle("~/" + name).advertise<nav_msgs::Path>("plan", 1)) {
  if (!model_problem_.empty()) ROS_WARN("no network can lead, only the route: %s", model_problem_.c_str());
  warnOfTheNetwork();
}

void PlanMaker::warnOfTheNetwork() const {
  const AgentParameters& agent = agent_.parameters();
  if (agent.leader != Leader::kNetwork) return;
  const std::string warning = sizeWarning(agent_.policy().description(), agent.shield.footprint_radius);
  if (!warning.empty()) ROS_WARN("%s", warning.c_str());
}

void PlanMaker::change(const GlobalPlannerParameters& parameters) {
  const bool is_to_lead = parameters.agent.leader == Leader::kNetwork;
  if (is_to_lead && !model_problem_.empty()) throw std::invalid_argument(model_problem_);
  const bool is_new_leader = parameters.agent.leader != agent_.parameters().leader;
  agent_.change(parameters.agent);
  if (is_new_leader) warnOfTheNetwork();
  markers_.setTraceLength(parameters.trace_length);
  parameters_ = parameters;
}

void PlanMaker::makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal_message,
                         std::vector<geometry_msgs::PoseStamped>* plan) {
  try {
    makePlanFromWhatIsHeard(start, goal_message, plan);
  } catch (const FutureTransform&) {
    // One that was on its way when the clock was set back. As long as tf holds it, it is the newest.
    tf_.clear();
    throw;
  }
}

void PlanMaker::makePlanFromWhatIsHeard(const geometry_msgs::PoseStamped& start,
                                        const geometry_msgs::PoseStamped& goal_message,
                                        std::vector<geometry_msgs::PoseStamped>* plan) {
  now_ = ros::Time::now();
  verdict_.reset();
  const GoalInFrame goal = goalFromMessage(goal_message);
  const SensorReading reading = sensors_.read(now_);
  tf_check_.note(reading, now_);
  global_from_odometry_ = frames_.transform(global_frame_, reading.odometry_frame, now_);
  checkStart(start, compose(global_from_odometry_, reading.newest_pose));
  corrections_.note(global_from_odometry_, reading.newest_pose);
  const long jumps = reading.jumps + corrections_.jumps();
  if (jumps != jumps_) drift_.restart();
  jumps_ = jumps;
  perceive(reading);
  sayThatTheScannerIsTooShort();

  hearOfGoals(goal);
  Pose2 global_goal =
      compose(frames_.transformAt(global_frame_, goal.frame, goal_message.header.stamp, now_), goal.pose);
  ask(goal, &global_goal);
  const bool is_new = verdict_ == GoalTracker::Verdict::kNewGoal;
  if (is_new) noteEnd(false);
  if (is_new) drift_.slip().clear();
  const bool driven = verdict_ != GoalTracker::Verdict::kQuestion;
  if (driven) checkMotion();
  const Pose2 asked = compose(drift_.correction(), global_goal);
  const Decision& decision = driven ? drive(global_goal, is_new) : preview(asked);
  if (driven) tracker_.setGivenUp(decision.choice == Decision::Move::kNoPath);
  const Pose2 agent_goal = driven ? goal_changes_.goal() : asked;
  const auto bent = bentAway(agent_, agent_.situation().pose, decision, parameters_.rollout.clearance);
  rollOut(agent_.situation(), bent.value_or(decision), agent_.shield(), agent_goal, parameters_.agent,
          parameters_.rollout, &plan_);
  const Pose2 global_from_agent = inverse(drift_.correction());
  for (Pose2& pose : plan_) pose = compose(global_from_agent, pose);
  toMessages(plan_, header(), plan);
  if (driven) {
    sayWhoLeads(decision);
    sayWhereGoalSeems(decision);
    publish(inParentFrame(global_from_agent, decision), compose(global_from_agent, agent_goal), *plan);
  }
  if (decision.choice != Decision::Move::kNoPath) return;
  if (driven) noteEnd(false);
  if (driven && end_) throw PlanRefused(end_->text());
  throw PlanRefused("there is no path to the goal: obstacles enclose the goal or the robot");
}

void PlanMaker::noteEnd(bool is_unasked) {
  const bool is_reported = goals_.takeSuccess();
  const Decision::Choice choice = agent_.decision().choice;
  const bool is_refused = choice == Decision::Move::kNoPath && agent_.endsBesideGoal();
  const Pose2 robot = robotOfAgent();
  // A report that is late may be about the goal before.
  const bool is_at_end = distanceBetween(robot, agent_.decision().destination) <= kFarthestEnd;
  const bool is_over = is_refused || (is_reported && is_at_end) || (is_unasked && choice == Decision::Move::kArrived);
  if (!is_over) return;
  const DriveEnd end{
      {driven_goal_.x, driven_goal_.y}, distanceBetween(robot, agent_.goal()), agent_.endsBesideGoal(), !is_refused};
  if (is_driving_) {
    is_driving_ = false;
    tellEnd(end);
    if (end.is_beside) ROS_WARN("%s", end.text().c_str());
  } else if (is_refused && !is_unasked && end_ && end.text() != end_->text()) {
    // After a refusal, move_base drives on along the last plan until the controller finds it too old.
    tellEnd(end);
  }
}

std::string PlanMaker::besideGoal() {
  return agent_.endsBesideGoal() ? besideGoalText(distanceBetween(robotOfAgent(), agent_.goal())) : "";
}

/// Where the robot is now, in the agent's frame.
Pose2 PlanMaker::robotOfAgent() {
  const Pose2 global_robot = compose(global_from_odometry_, sensors_.newestPose().value_or(Pose2()));
  return compose(drift_.correction(), global_robot);
}

void PlanMaker::tellEnd(const DriveEnd& end) {
  end_ = end;
  arrival_.publish(end, global_frame_);
}

void PlanMaker::checkStart(const geometry_msgs::PoseStamped& start, const Pose2& robot) const {
  constexpr double kFarthestStart = 1.0;
  if (frameName(start.header.frame_id) != global_frame_) {
    throw PlanRefused("the start is in frame '" + start.header.frame_id + "', expected " + global_frame_);
  }
  const double distance = distanceBetween(start.pose.position, robot);
  if (!(distance <= kFarthestStart)) {
    throw PlanRefused("the start is " + fixedText(distance, 2) + " m from the robot (" +
                      ros::NodeHandle().resolveName(parameters_.sensors.odom_topic) +
                      "), plans are made only from where it stands: if tf has the pose of another odometry, as of an "
                      "EKF, odom_topic must be the topic of that one");
  }
}

void PlanMaker::checkMotion() {
  const double slipped = drift_.slip().slipped();
  if (slipped == 0.0) return;
  throw PlanRefused("by " + ros::NodeHandle().resolveName(parameters_.sensors.odom_topic) + " the robot has moved by " +
                    fixedText(slipped, 1) +
                    " m (or rad), by the scans it stands: the wheels slip, an EKF goes on without the wheels, or the "
                    "scanner repeats an old scan. Move the robot by 0.3 m, or give a new goal");
}

void PlanMaker::perceive(const SensorReading& reading) {
  lstm_planner::perceive(reading, global_from_odometry_, parameters_.sensors.scan_rules,
                         agent_.policy().description().encoder.range_cap, &seen_);
  warnOfReturnsInside();
  const Pose2 global_pose = seen_.pose;
  if (isDriftCorrected(reading)) drift_.correct(&seen_);
  agent_.perceive(seen_);
  seen_.pose = global_pose;
  if (!costmap_.isUsed()) return;
  // Cells around what is known to the centimetre would only make it larger.
  known_ = agent_.outOfView();
  known_.insert(known_.end(), seen_.obstacles.begin(), seen_.obstacles.end());
  agent_.mark(costmap_.read(seen_.pose, known_));
}

void PlanMaker::warnOfReturnsInside() const {
  constexpr double kWarnPeriod = 10.0;  // s
  const std::string inside = returnsInside(seen_.obstacles, agent_.shield().footprint());
  if (!inside.empty()) ROS_WARN_THROTTLE(kWarnPeriod, "the robot may stand for ever: %s", inside.c_str());
}

/// A localisation corrects the other frames, better than scans alone can.
bool PlanMaker::isDriftCorrected(const SensorReading& reading) const {
  return parameters_.agent.correct_drift && frameName(reading.odometry_frame) == global_frame_;
}

void PlanMaker::hearOfGoals(const GoalInFrame& asked) {
  // In this order, so that the drive is not an older one than that of the goal.
  const auto announced = goals_.takeAnnouncement();
  tracker_.setDrive(goals_.drive());
  if (announced) {
    // move_base tries to transform it in each cycle, announces it again, and follows no plan.
    is_untransformed_ = !announces_each_plan_ && announced->frame_id != global_frame_ && announced_ &&
                        isRepeated(*announced_, *announced);
    if (!is_untransformed_) tracker_.announce(announcedIn(asked.frame, *announced));
    announced_ = announced;
  }
  if (is_untransformed_ && sameGoal(announced_->goal, asked)) {
    throw PlanRefused("move_base could not transform the goal from frame '" + announced_->frame_id + "' to " +
                      global_frame_ + ": its log says why");
  }
}

void PlanMaker::ask(const GoalInFrame& goal, Pose2* goal_in_global_frame) {
  verdict_ = tracker_.ask(goal, now_.toSec());
  if (verdict_ == GoalTracker::Verdict::kNewGoal || verdict_ == GoalTracker::Verdict::kMoved) {
    driven_goal_ = *goal_in_global_frame;
  } else if (verdict_ == GoalTracker::Verdict::kDriven) {
    // A goal given in a frame that moves (the robot's own) stays where it was when it was given.
    *goal_in_global_frame = driven_goal_;
  }
}

/// As it will be asked for: move_base_flex announces a goal as it was given, and since 0.4.0 asks for it in the frame
/// of the costmap.
GoalInFrame PlanMaker::announcedIn(const std::string& frame, const AnnouncedGoal& announced) const {
  const GoalInFrame& goal = announced.goal;
  if (frame != global_frame_) return goal;
  try {
    return {frame, compose(frames_.transformAt(frame, goal.frame, announced.stamp, now_), goal.pose)};
  } catch (const FrameError&) {
    return goal;
  }
}

const Decision& PlanMaker::drive(const Pose2& goal, bool is_new) {
  switch (goal_changes_.tell(&agent_, goal, drift_.correction(), is_new, jumps_)) {
    case GoalChanges::Fresh::kNewGoal:
    case GoalChanges::Fresh::kGoalMoved:
      ROS_INFO("new goal (%.2f, %.2f) in %s", driven_goal_.x, driven_goal_.y, global_frame_.c_str());
      markers_.clearTrace();
      said_of_goal_.clear();
      is_driving_ = true;
      end_.reset();
      break;
    case GoalChanges::Fresh::kJump:
      ROS_WARN(
          "the odometry jumped, or the localisation moved the robot: the path so far and the remembered obstacles are "
          "deleted; the goal keeps its coordinates");
      markers_.clearTrace();
      break;
    case GoalChanges::Fresh::kNo:
      break;
  }
  return agent_.decide();
}

/// Once, and again if a scan reached far enough in between.
void PlanMaker::sayThatTheScannerIsTooShort() {
  const std::string warning = agent_.standInWarning();
  if (!warning.empty() && !said_too_short_) ROS_WARN("%s", warning.c_str());
  said_too_short_ = !warning.empty();
}

void PlanMaker::sayWhoLeads(const Decision& decision) {
  if (decision.leader == leader_) return;
  leader_ = decision.leader;
  ROS_INFO("from step %ld on the %s leads: %s", decision.step, toString(decision.leader), decision.why);
}

/// Each once a goal: what is seen of a wall changes from step to step.
void PlanMaker::sayWhereGoalSeems(const Decision& decision) {
  using GoalSeems = Decision::GoalSeems;
  if (decision.goal_seems == GoalSeems::kReachable || !said_of_goal_.insert(decision.goal_seems).second) return;
  const Pose2& robot = agent_.situation().pose;
  switch (decision.goal_seems) {
    case GoalSeems::kInObstacle:
      sayWhatIsInTheWay(decision);
      break;
    case GoalSeems::kBehindObstacle:
      ROS_INFO(
          "the goal is %.2f m away, but the path to it is %.1f m long: odometry may have moved it behind a wall. It "
          "counts as reached within %.2f m (goal_drift)",
          distanceBetween(robot, agent_.goal()), distanceBetween(robot, decision.waypoint) + lengthOf(decision.path_on),
          agent_.reachedWithin());
      break;
    case GoalSeems::kEnclosed:
      ROS_WARN("no path to the goal is known: the robot looks around, then tries narrower passages");
      break;
    case GoalSeems::kReachable:
      break;
  }
}

void PlanMaker::sayWhatIsInTheWay(const Decision& decision) const {
  if (agent_.endsBesideGoal()) {
    ROS_WARN("the goal seems to lie in an obstacle, or odometry has moved it there: the path ends %.2f m from it",
             distanceBetween(decision.destination, agent_.goal()));
    return;
  }
  ROS_WARN(
      "the goal seems to lie in or behind an obstacle: it is %.2f m away, and no path to it is known. It counts as "
      "reached within %.2f m (goal_drift)",
      distanceBetween(agent_.situation().pose, agent_.goal()), agent_.reachedWithin());
}

const Decision& PlanMaker::preview(const Pose2& goal) {
  preview_ = agent_.preview({goal.x, goal.y});
  return preview_;
}

std_msgs::Header PlanMaker::header() const {
  std_msgs::Header header;
  header.frame_id = global_frame_;
  header.stamp = now_;
  return header;
}

void PlanMaker::publish(const Decision& decision, const Pose2& goal,
                        const std::vector<geometry_msgs::PoseStamped>& plan) {
  markers_.publish(header(), seen_, decision, goal);
  decisions_.publish(header(), seen_, decision, goal);
  if (plan_publisher_.getNumSubscribers() > 0) {
    nav_msgs::Path path;
    path.header = header();
    path.poses = plan;
    plan_publisher_.publish(path);
  }
}

}  // namespace lstm_planner
