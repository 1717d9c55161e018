#include <actionlib/server/simple_action_server.h>
#include <geometry_msgs/PoseStamped.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <move_base_msgs/MoveBaseActionGoal.h>
#include <nav_msgs/GetPlan.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/ros.h>
#include <tf2/LinearMath/Matrix3x3.h>
#include <tf2/LinearMath/Quaternion.h>
#include <tf2/exceptions.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>
#include <tf2_ros/buffer.h>

#include <atomic>
#include <cmath>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"
#include "lstm_planner/ros/common/transform_listener.hpp"
#include "lstm_planner/ros/move_base/standalone_move_base_parameters.hpp"
#include "ros/common/node_main.hpp"
#include "ros/common/timing.hpp"
#include "ros/move_base/standalone_move_base_planner_thread.hpp"
#include "ros/move_base/standalone_move_base_plugins.hpp"

namespace lstm_planner {

namespace {

constexpr double kTransformTimeout = 0.5;     // s
constexpr double kSmallestQuaternion = 1e-6;  // squared length
constexpr double kLargestTilt = 1e-3;         // 1 - cos of the angle to the vertical

geometry_msgs::Quaternion uprightRotation(const geometry_msgs::Quaternion& message) {
  tf2::Quaternion rotation(message.x, message.y, message.z, message.w);
  const double squared_length = rotation.length2();
  if (!std::isfinite(squared_length) || squared_length < kSmallestQuaternion) {
    throw std::invalid_argument("the goal's orientation is a zero quaternion, or not finite");
  }
  rotation.normalize();
  if (std::abs(1.0 - tf2::Matrix3x3(rotation)[2][2]) > kLargestTilt) {
    throw std::invalid_argument("the goal's orientation is tilted; a rotation about the vertical is expected");
  }
  return tf2::toMsg(rotation);
}

/// The goal in `frame`, at the newest transform. Throws std::invalid_argument when it has no frame, a position that is
/// not finite, an orientation that is no rotation about the vertical, or a frame that tf does not connect to `frame`.
geometry_msgs::PoseStamped goalInFrame(const geometry_msgs::PoseStamped& goal, const std::string& frame,
                                       const tf2_ros::Buffer& tf) {
  geometry_msgs::PoseStamped upright = goal;
  std::string& goal_frame = upright.header.frame_id;
  if (!goal_frame.empty() && goal_frame.front() == '/') goal_frame.erase(0, 1);
  if (goal_frame.empty()) throw std::invalid_argument("the goal has no frame_id");
  const auto& position = goal.pose.position;
  if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) {
    throw std::invalid_argument("the goal's position is not finite");
  }
  upright.pose.orientation = uprightRotation(goal.pose.orientation);
  if (goal_frame == frame) return upright;
  // The newest transform: a goal clicked a while ago still means the place it names now.
  upright.header.stamp = ros::Time(0);
  try {
    return tf.transform(upright, frame, ros::Duration(kTransformTimeout));
  } catch (const tf2::TransformException& exception) {
    throw std::invalid_argument("the goal's frame '" + goal_frame + "' is not connected to '" + frame + "' by tf (" +
                                exception.what() + ")");
  }
}

constexpr double kDrivesOn = 1.0;  // s after the last plan, without one to the new goal

std::string withUnit(double value, const char* unit) { return numberText(value) + ' ' + unit; }

// A service call must not keep the spinning thread, which receives the scan, for long: few neighbours are tried.
constexpr int kRings = 3;
constexpr int kNeighboursPerRing = 8;

// Parameters of the real move_base that are of no use without a costmap and recovery behaviours; config/move_base.yaml
// sets some of them. Nobody is warned of them.
constexpr const char* kOnlyOfTheRealMoveBase[] = {
    "aggressive_reset",        "clearing_radius",      "clearing_rotation_allowed", "conservative_reset",
    "conservative_reset_dist", "circumscribed_radius", "inscribed_radius",          "make_plan_add_unreachable_goal",
    "make_plan_clear_costmap", "max_planning_retries", "recovery_behavior_enabled", "recovery_behaviors",
    "shutdown_costmaps"};

/// The part of a plugin's name after the package, which is the name of its namespace.
std::string classOf(const std::string& plugin) { return plugin.substr(plugin.find_last_of("/:") + 1); }

/// Reads the node's private namespace; leaves what is not set at its default. Throws std::invalid_argument naming the
/// parameter, its value and what was expected.
StandaloneMoveBaseParameters loadStandaloneMoveBaseParameters(const ros::NodeHandle& private_node) {
  StandaloneMoveBaseParameters parameters;
  ParameterReader reader(private_node);
  visitStandaloneMoveBaseParameters(parameters, reader.visitor(private_node.getNamespace() + "/"));
  for (const char* name : kOnlyOfTheRealMoveBase) {
    reader.know(name);
    reader.knowGroup(name);
  }
  reader.knowRobotFile();
  reader.knowGroup(classOf(parameters.base_global_planner));
  reader.knowGroup(classOf(parameters.base_local_planner));
  reader.warnOfUnknown();
  return parameters;
}

/// Hosts a global planner and a controller plugin behind move_base's public ROS interface, for ROS distributions
/// without the navigation stack. What it does with the two plugins is what move_base does: the planner runs in a thread
/// of its own, the controller at a fixed rate while a goal is active. There is no costmap and no recovery behaviour.
///
/// Interface:
///  - action `move_base` (move_base_msgs/MoveBase): goals in any frame that tf connects to the global frame; a goal
///    that cannot be reached is aborted with a text that says why
///  - topic `move_base_simple/goal` (geometry_msgs/PoseStamped), subscribed
///  - topic `~current_goal` (geometry_msgs/PoseStamped): each accepted goal, in the global frame
///  - topic `cmd_vel` (geometry_msgs/Twist): zero once whenever driving ends
///  - service `~make_plan` (nav_msgs/GetPlan): refused while a goal is active
///
/// Parameters (~): standalone_move_base_parameters.hpp, those of the plugins, and in `global_costmap` and
/// `local_costmap` those of costmap_2d::Costmap2DROS in compat/.
///
/// Takes the goals and pursues one at a time: looks for a plan, drives along it, looks for a new one when the
/// controller finds no velocity. A goal that takes another one's place does not stop the robot: it drives on along the
/// last plan until there is one to the new goal.
class StandaloneMoveBase {
 public:
  /// Reads the parameters, loads both plugins and takes goals from then on. `tf` must outlive the object and be filled
  /// by a listener with a thread of its own. Throws std::runtime_error when a parameter is out of its range or a plugin
  /// cannot be loaded.
  explicit StandaloneMoveBase(tf2_ros::Buffer& tf);

  /// Ends an active goal, stops the robot, and shuts ROS down; safe after ros::shutdown(), too.
  ~StandaloneMoveBase();

 private:
  using Server = actionlib::SimpleActionServer<move_base_msgs::MoveBaseAction>;
  enum class State { kPlanning, kControlling };

  // In the spinning thread.
  void forwardGoal(const geometry_msgs::PoseStamped::ConstPtr& goal);
  bool servePlan(nav_msgs::GetPlan::Request& request, nav_msgs::GetPlan::Response& response);
  bool planWithinTolerance(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                           double tolerance, Plan& plan);

  // In the planner's thread.
  bool planFromRobot(const geometry_msgs::PoseStamped& goal, Plan& plan);

  // In the action's thread. Those that return bool say whether the goal is still pursued.
  void pursue(const move_base_msgs::MoveBaseGoalConstPtr& goal);
  bool start(const move_base_msgs::MoveBaseGoal& goal, State state);
  bool handlePreemption();
  bool step();
  bool takePlan();
  bool waitForPlan();
  bool drive();
  bool mayDriveOn();
  bool recoverController();
  bool isOscillating(const geometry_msgs::PoseStamped& robot);

  void stopRobot();
  void succeed();
  void abort(const std::string& text);

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  tf2_ros::Buffer& tf_;
  const StandaloneMoveBaseParameters parameters_;
  HostedPlugins plugins_;
  std::atomic<bool> pose_known_{true};
  std::atomic<bool> finished_{false};
  PlannerThread planner_;

  State state_ = State::kPlanning;
  bool plan_is_to_goal_ = false;  ///< the controller's plan
  Stopwatch last_plan_;           ///< to this goal or to an earlier one
  Stopwatch last_valid_plan_;     ///< to this goal
  Stopwatch last_valid_control_;
  Stopwatch last_progress_;
  geometry_msgs::PoseStamped progress_pose_;

  ros::Publisher velocity_publisher_;
  ros::Publisher current_goal_publisher_;
  ros::Publisher action_goal_publisher_;
  ros::Subscriber simple_goal_subscriber_;
  ros::ServiceServer plan_service_;
  Server server_;
};

StandaloneMoveBase::StandaloneMoveBase(tf2_ros::Buffer& tf)
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
  simple_goal_subscriber_ = node_.subscribe("move_base_simple/goal", 1, &StandaloneMoveBase::forwardGoal, this);
  plan_service_ = private_node_.advertiseService("make_plan", &StandaloneMoveBase::servePlan, this);
  server_.start();
}

StandaloneMoveBase::~StandaloneMoveBase() {
  const ros::WallDuration moment(0.1);
  simple_goal_subscriber_.shutdown();
  plan_service_.shutdown();
  const bool drives = server_.isActive();
  finished_ = true;
  if (drives && ros::ok()) {
    moment.sleep();  // until no more commands come
    stopRobot();
    moment.sleep();  // so that the message still leaves
  }
  ros::shutdown();  // the action's thread would sleep on where the clock stands
  server_.shutdown();
}

void StandaloneMoveBase::pursue(const move_base_msgs::MoveBaseGoalConstPtr& goal) {
  if (!start(*goal, State::kPlanning)) return;
  ros::Rate rate(parameters_.controller_frequency);
  while (ros::ok() && !finished_ && server_.isActive()) {
    if (!handlePreemption() || !step()) return;
    rate.sleep();
  }
  planner_.stop();
  stopRobot();  // the last command may have been worked out while the destructor sent its zero
  if (server_.isActive()) server_.setAborted({}, "The node has been shut down.");
}

bool StandaloneMoveBase::start(const move_base_msgs::MoveBaseGoal& goal, State state) {
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
  planner_.start(target);
  current_goal_publisher_.publish(target);
  return true;
}

bool StandaloneMoveBase::handlePreemption() {
  if (!server_.isPreemptRequested()) return true;
  if (server_.isNewGoalAvailable()) return start(*server_.acceptNewGoal(), state_);
  planner_.stop();
  stopRobot();
  server_.setPreempted({}, "The goal was cancelled.");
  return false;
}

bool StandaloneMoveBase::step() {
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

bool StandaloneMoveBase::takePlan() {
  const std::optional<MadePlan> made = planner_.takePlan();
  if (!made) return true;
  if (!plugins_.setPlan(made->plan)) {
    abort("The controller refused the plan.");
    return false;
  }
  plan_is_to_goal_ = made->is_to_goal;
  last_plan_.restart();
  if (plan_is_to_goal_) last_valid_plan_.restart();
  state_ = State::kControlling;
  return true;
}

bool StandaloneMoveBase::waitForPlan() {
  // A planner slower than the patience still gets its one chance.
  if (planner_.failures() == 0 || !last_valid_plan_.isLongerAgo(parameters_.planner_patience)) return true;
  const std::string duration = withUnit(parameters_.planner_patience, "s");
  abort(pose_known_ ? "No plan was found for " + duration +
                          ": there is no path to the goal, or the planner has no sensor data (its messages say which)."
                    : "No plan was found for " + duration + ": the robot's pose in frame '" + plugins_.globalFrame() +
                          "' is unknown.");
  return false;
}

bool StandaloneMoveBase::drive() {
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
bool StandaloneMoveBase::mayDriveOn() { return planner_.failures() == 0 && !last_plan_.isLongerAgo(kDrivesOn); }

bool StandaloneMoveBase::recoverController() {
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

bool StandaloneMoveBase::isOscillating(const geometry_msgs::PoseStamped& robot) {
  if (parameters_.oscillation_timeout <= 0.0) return false;
  if (distanceBetween(progress_pose_.pose.position, robot.pose.position) >= parameters_.oscillation_distance) {
    progress_pose_ = robot;
    last_progress_.restart();
  }
  return last_progress_.isLongerAgo(parameters_.oscillation_timeout);
}

void StandaloneMoveBase::stopRobot() { velocity_publisher_.publish(geometry_msgs::Twist()); }

void StandaloneMoveBase::succeed() {
  planner_.stop();
  stopRobot();
  const std::string beside = plugins_.besideGoal();
  server_.setSucceeded({}, beside.empty() ? "Goal reached." : "Goal reached: " + beside + ".");
}

void StandaloneMoveBase::abort(const std::string& text) {
  planner_.stop();
  stopRobot();
  ROS_ERROR("%s", text.c_str());
  server_.setAborted({}, text);
}

bool StandaloneMoveBase::planFromRobot(const geometry_msgs::PoseStamped& goal, Plan& plan) {
  geometry_msgs::PoseStamped start;
  pose_known_ = plugins_.robotPose(start);
  return pose_known_ && plugins_.makePlan(start, goal, plan);
}

void StandaloneMoveBase::forwardGoal(const geometry_msgs::PoseStamped::ConstPtr& goal) {
  move_base_msgs::MoveBaseActionGoal action_goal;
  action_goal.header.stamp = ros::Time::now();
  action_goal.goal.target_pose = *goal;
  action_goal_publisher_.publish(action_goal);
}

bool StandaloneMoveBase::servePlan(nav_msgs::GetPlan::Request& request, nav_msgs::GetPlan::Response& response) {
  if (server_.isActive()) {
    ROS_ERROR("make_plan is not served while a goal is active");
    return false;
  }
  try {
    geometry_msgs::PoseStamped start;
    if (!request.start.header.frame_id.empty()) {
      start = goalInFrame(request.start, plugins_.globalFrame(), tf_);
    } else if (!plugins_.robotPose(start)) {
      ROS_ERROR("make_plan: no start was given and the robot's pose is unknown");
      return false;
    }
    const geometry_msgs::PoseStamped goal = goalInFrame(request.goal, plugins_.globalFrame(), tf_);
    planWithinTolerance(start, goal, request.tolerance, response.plan.poses);
    response.plan.header.frame_id = plugins_.globalFrame();
    response.plan.header.stamp = ros::Time::now();
    return true;
  } catch (const std::invalid_argument& exception) {
    ROS_ERROR("make_plan: %s", exception.what());
    return false;
  }
}

bool StandaloneMoveBase::planWithinTolerance(const geometry_msgs::PoseStamped& start,
                                             const geometry_msgs::PoseStamped& goal, double tolerance, Plan& plan) {
  if (plugins_.makePlan(start, goal, plan)) return true;
  plan.clear();
  if (!std::isfinite(tolerance) || tolerance <= 0.0) return false;
  for (int ring = 1; ring <= kRings; ++ring) {
    const double radius = tolerance * ring / kRings;
    for (int neighbour = 0; neighbour < kNeighboursPerRing; ++neighbour) {
      const double direction = 2.0 * M_PI * neighbour / kNeighboursPerRing;
      geometry_msgs::PoseStamped nearby = goal;
      nearby.pose.position.x += radius * std::cos(direction);
      nearby.pose.position.y += radius * std::sin(direction);
      if (plugins_.makePlan(start, nearby, plan)) return true;
    }
  }
  plan.clear();
  return false;
}

}  // namespace

}  // namespace lstm_planner

int main(int argc, char** argv) {
  return lstm_planner::runUntilStopped(argc, argv, "move_base", [](const ros::NodeHandle& /*node*/, const auto& stop) {
    try {
      tf2_ros::Buffer transforms;
      const lstm_planner::TransformListener listener(&transforms);
      lstm_planner::StandaloneMoveBase move_base(transforms);
      while (ros::ok() && stop == 0) ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
    } catch (const std::exception& exception) {
      ROS_FATAL("standalone_move_base: %s", exception.what());
      return 1;
    }
    return 0;
  });
}
