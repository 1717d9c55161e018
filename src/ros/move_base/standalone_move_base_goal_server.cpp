#include "ros/move_base/standalone_move_base_goal_server.hpp"

#include <move_base_msgs/MoveBaseActionGoal.h>
#include <ros/ros.h>

#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "lstm_planner/drive/decision/arrival.hpp"
#include "ros/move_base/standalone_move_base_goal.hpp"

namespace lstm_planner {
namespace {

constexpr double kDrivesOn = 1.0;  // s after the last plan, without one to the new goal

std::string withUnit(double value, const char* unit) {
  std::ostringstream text;
  text << value << ' ' << unit;
  return text.str();
}

double distanceBetweenPoses(const geometry_msgs::PoseStamped& a, const geometry_msgs::PoseStamped& b) {
  return std::hypot(b.pose.position.x - a.pose.position.x, b.pose.position.y - a.pose.position.y);
}

}  // namespace

StandaloneMoveBase::GoalServer::GoalServer(tf2_ros::Buffer& tf)
    : tf_(tf),
      parameters_(loadStandaloneMoveBaseParameters(private_node_)),
      plugins_(parameters_.base_global_planner, parameters_.base_local_planner, tf),
      planner_([this](const geometry_msgs::PoseStamped& goal, Plan& plan) { return planFromRobot(goal, plan); },
               parameters_.planner_frequency),
      velocity_publisher_(node_.advertise<geometry_msgs::Twist>("cmd_vel", 1)),
      current_goal_publisher_(private_node_.advertise<geometry_msgs::PoseStamped>("current_goal", 0)),
      action_goal_publisher_(node_.advertise<move_base_msgs::MoveBaseActionGoal>("move_base/goal", 1)),
      server_(
          node_, "move_base", [this](const move_base_msgs::MoveBaseGoalConstPtr& goal) { pursue(goal); }, false) {
  simple_goal_subscriber_ = node_.subscribe("move_base_simple/goal", 1, &GoalServer::forwardGoal, this);
  plan_service_ = private_node_.advertiseService("make_plan", &GoalServer::servePlan, this);
  server_.start();
}

StandaloneMoveBase::GoalServer::~GoalServer() {
  finished_ = true;
  simple_goal_subscriber_.shutdown();
  plan_service_.shutdown();
  server_.shutdown();
}

void StandaloneMoveBase::GoalServer::pursue(const move_base_msgs::MoveBaseGoalConstPtr& goal) {
  if (!start(*goal, State::kPlanning)) return;
  ros::Rate rate(parameters_.controller_frequency);
  while (ros::ok() && !finished_ && server_.isActive()) {
    if (!handlePreemption() || !step()) return;
    rate.sleep();
  }
  planner_.stop();
  if (server_.isActive()) server_.setAborted({}, "The node has been shut down.");
}

bool StandaloneMoveBase::GoalServer::start(const move_base_msgs::MoveBaseGoal& goal, State state) {
  geometry_msgs::PoseStamped target;
  try {
    target = goalInFrame(goal.target_pose, plugins_.globalFrame(), tf_);
  } catch (const std::invalid_argument& exception) {
    abort(std::string("The goal was refused: ") + exception.what() + ".");
    return false;
  }
  state_ = state;
  plan_is_to_goal_ = false;
  last_valid_plan_.restart();
  last_valid_control_.restart();
  last_progress_.restart();
  if (state == State::kPlanning) stopRobot();
  goal_ = target;
  planner_.start(target);
  current_goal_publisher_.publish(target);
  return true;
}

bool StandaloneMoveBase::GoalServer::handlePreemption() {
  if (!server_.isPreemptRequested()) return true;
  if (server_.isNewGoalAvailable()) return start(*server_.acceptNewGoal(), state_);
  planner_.stop();
  stopRobot();
  server_.setPreempted({}, "The goal was cancelled.");
  return false;
}

bool StandaloneMoveBase::GoalServer::step() {
  geometry_msgs::PoseStamped robot;
  if (plugins_.robotPose(robot)) {
    move_base_msgs::MoveBaseFeedback feedback;
    feedback.base_position = robot;
    server_.publishFeedback(feedback);
    if (isOscillating(robot)) {
      abort("The robot has stayed within " + withUnit(parameters_.oscillation_distance, "m") + " for " +
            withUnit(parameters_.oscillation_timeout, "s") + ".");
      return false;
    }
  }
  if (!takePlan()) return false;
  return state_ == State::kPlanning ? waitForPlan() : drive();
}

bool StandaloneMoveBase::GoalServer::takePlan() {
  const std::optional<MadePlan> made = planner_.takePlan();
  if (!made) return true;
  if (!plugins_.setPlan(made->plan)) {
    abort("The controller refused the plan.");
    return false;
  }
  plan_is_to_goal_ = made->is_to_goal;
  if (plan_is_to_goal_) plan_end_ = made->plan.back();
  last_plan_.restart();
  if (plan_is_to_goal_) last_valid_plan_.restart();
  state_ = State::kControlling;
  return true;
}

bool StandaloneMoveBase::GoalServer::waitForPlan() {
  // A planner slower than the patience still gets its one chance.
  if (planner_.failures() == 0 || !last_valid_plan_.isLongerAgo(parameters_.planner_patience)) return true;
  const std::string duration = withUnit(parameters_.planner_patience, "s");
  abort(pose_known_ ? "No plan was found for " + duration +
                          ": there is no path to the goal, or the planner has no sensor data (its messages say which)."
                    : "No plan was found for " + duration + ": the robot's pose in frame '" + plugins_.globalFrame() +
                          "' is unknown.");
  return false;
}

bool StandaloneMoveBase::GoalServer::drive() {
  if (!plan_is_to_goal_ && !mayDriveOn()) {
    stopRobot();
    state_ = State::kPlanning;
    return true;
  }
  if (plan_is_to_goal_ && plugins_.isGoalReached()) {
    succeed();
    return false;
  }
  geometry_msgs::Twist velocity;
  if (!plugins_.computeVelocity(velocity)) return recoverController();
  last_valid_control_.restart();
  velocity_publisher_.publish(velocity);
  return true;
}

/// Along a plan to an earlier goal.
bool StandaloneMoveBase::GoalServer::mayDriveOn() {
  return planner_.failures() == 0 && !last_plan_.isLongerAgo(kDrivesOn);
}

bool StandaloneMoveBase::GoalServer::recoverController() {
  if (last_valid_control_.isLongerAgo(parameters_.controller_patience)) {
    abort("The controller found no safe velocity for " + withUnit(parameters_.controller_patience, "s") + ".");
    return false;
  }
  stopRobot();
  state_ = State::kPlanning;
  last_valid_plan_.restart();
  planner_.request();
  return true;
}

bool StandaloneMoveBase::GoalServer::isOscillating(const geometry_msgs::PoseStamped& robot) {
  if (parameters_.oscillation_timeout <= 0.0) return false;
  if (distanceBetweenPoses(progress_pose_, robot) >= parameters_.oscillation_distance) {
    progress_pose_ = robot;
    last_progress_.restart();
  }
  return last_progress_.isLongerAgo(parameters_.oscillation_timeout);
}

void StandaloneMoveBase::GoalServer::stopRobot() { velocity_publisher_.publish(geometry_msgs::Twist()); }

void StandaloneMoveBase::GoalServer::succeed() {
  planner_.stop();
  stopRobot();
  server_.setSucceeded({}, arrivalText());
}

/// A plan that ends beside the goal is one to a goal in or behind an obstacle.
std::string StandaloneMoveBase::GoalServer::arrivalText() const {
  geometry_msgs::PoseStamped robot;
  const bool is_beside = distanceBetweenPoses(plan_end_, goal_) > AgentParameters().goal_tolerance;
  if (!is_beside || !plugins_.robotPose(robot)) return "Goal reached.";
  return "Goal reached: " + besideGoalText(distanceBetweenPoses(robot, goal_)) + ".";
}

void StandaloneMoveBase::GoalServer::abort(const std::string& text) {
  planner_.stop();
  stopRobot();
  ROS_ERROR("%s", text.c_str());
  server_.setAborted({}, text);
}

}  // namespace lstm_planner
