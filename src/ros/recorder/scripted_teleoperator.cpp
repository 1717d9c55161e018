#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2_ros/buffer.h>

#include <cmath>
#include <csignal>
#include <optional>
#include <string>

#include "lstm_planner/drive/perception/odometry_history.hpp"
#include "lstm_planner/grid/map_server_map.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "lstm_planner/ros/common/transform_listener.hpp"
#include "lstm_planner/ros/recorder/teleoperator_parameters.hpp"
#include "lstm_planner/simulation/world.hpp"
#include "ros/common/node_main.hpp"

namespace lstm_planner {

namespace {

constexpr double kFastest = 5.0;     // m/s; a true pose that moves faster was put somewhere else
constexpr double kGoalMoved = 0.05;  // m; a goal that odometry or localisation moved by this is looked at anew
constexpr double kWarnPeriod = 5.0;  // s
// To stand, but with a turn (rad/s) that no robot can make: a driver whose robot stands is still at work, and a
// simulation whose clock waits for commands (create2_stub's command_period) is to wait for the next one, too.
constexpr Twist2 kStanding{0.0, 1e-9};
const ros::WallDuration kPoll(0.05);

/// The node `scripted_teleoperator`: drives like a person at the keys (ScriptedDriver) to goals, for recordings without
/// anybody. Publishes `cmd_vel` while it has a goal, and once more, zeros, when it has none.
///
/// Goals (geometry_msgs/PoseStamped, any frame that tf connects with the base) come from a topic; or it has waypoints
/// of its own, which it drives to one after another, over and over, and publishes on `~goal` (latched). The robot's
/// pose comes from the topic `ground_truth` (nav_msgs/Odometry in the map frame), as create2_stub has it, or, where
/// nobody publishes that, from tf. Stands still while the pose is old, while the goal's frame is not known, and when
/// whoever gives the goals has gone.
class ScriptedTeleoperator {
 public:
  /// Throws MapFileError, or std::invalid_argument.
  explicit ScriptedTeleoperator(const TeleoperatorParameters& parameters);

  /// Drives until the goals are done, `stop` is set, or ROS shuts down. Returns the exit code: 0, or 1 when there was
  /// no path to one of the goals.
  int run(const volatile std::sig_atomic_t& stop);

 private:
  struct Localised {
    Pose2 pose;  ///< of the base in the map frame
    double stamp = 0.0;
  };

  void onGoal(const geometry_msgs::PoseStamped::ConstPtr& message);
  void onTruth(const nav_msgs::Odometry::ConstPtr& message);
  void onTimer(const ros::TimerEvent& event);
  Twist2 steer();
  void chooseWaypoint();
  void endGoal(const char* how);
  bool isDone() const { return parameters_.goals > 0 && ended_ >= parameters_.goals; }
  std::optional<Localised> localise() const;
  std::optional<Localised> lookUp(const std::string& target, const std::string& source) const;
  std::optional<Point2> goalInMap() const;
  void publish(const Twist2& twist);

  TeleoperatorParameters parameters_;
  GridWorld world_;
  ScriptedDriver driver_;
  OdometryHistory truth_;
  std::optional<geometry_msgs::PoseStamped> goal_;
  std::optional<Point2> driven_to_;  ///< map frame, where the driver thinks that the goal is
  std::size_t next_waypoint_ = 0;
  int ended_ = 0;    ///< goals that were arrived at, replaced, or impossible
  int no_path_ = 0;  ///< of these
  bool moving_ = false;

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  tf2_ros::Buffer tf_;
  TransformListener listener_{&tf_};
  ros::Subscriber goal_subscriber_;
  ros::Subscriber truth_subscriber_;
  ros::Publisher goal_publisher_;
  ros::Publisher command_publisher_;
  ros::Timer timer_;
};

ScriptedTeleoperator::ScriptedTeleoperator(const TeleoperatorParameters& parameters)
    : parameters_(parameters),
      world_(readMapServerMap(resolvedPath(parameters.map), parameters.free_threshold)),
      driver_(world_, parameters.driver, static_cast<std::uint64_t>(parameters.seed)),
      truth_(kFastest) {
  command_publisher_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  // Small messages would otherwise wait some 40 ms for each other, which is long where the clock runs fast.
  const auto hints = ros::TransportHints().tcpNoDelay();
  truth_subscriber_ = node_.subscribe("ground_truth", 100, &ScriptedTeleoperator::onTruth, this, hints);
  if (parameters_.waypoints.empty()) {
    goal_subscriber_ = node_.subscribe(parameters_.goal_topic, 10, &ScriptedTeleoperator::onGoal, this);
  } else {
    goal_publisher_ = private_node_.advertise<geometry_msgs::PoseStamped>("goal", 1, true);
  }
  timer_ = node_.createTimer(ros::Duration(1.0 / parameters_.rate), &ScriptedTeleoperator::onTimer, this);
}

int ScriptedTeleoperator::run(const volatile std::sig_atomic_t& stop) {
  while (ros::ok() && stop == 0 && !isDone()) ros::getGlobalCallbackQueue()->callAvailable(kPoll);
  timer_.stop();
  if (ros::ok()) {
    publish({});
    kPoll.sleep();  // so that the message still leaves
  }
  return no_path_ == 0 ? 0 : 1;
}

void ScriptedTeleoperator::onGoal(const geometry_msgs::PoseStamped::ConstPtr& message) {
  if (goal_) endGoal("replaced");
  goal_ = *message;
  driven_to_.reset();
}

void ScriptedTeleoperator::onTruth(const nav_msgs::Odometry::ConstPtr& message) {
  const Pose2 pose = fromMessage(message->pose.pose);
  if (!isFinite(pose)) return;
  truth_.add({message->header.stamp.toSec(), pose, {}});
}

void ScriptedTeleoperator::chooseWaypoint() {
  const Pose2& place = parameters_.waypoints[next_waypoint_++ % parameters_.waypoints.size()].pose;
  goal_ = toMessage({place.x, place.y, 0.0}, parameters_.map_frame, ros::Time::now());
  driven_to_.reset();
  goal_publisher_.publish(*goal_);
}

void ScriptedTeleoperator::endGoal(const char* how) {
  ++ended_;
  ROS_INFO("goal %d (%.2f, %.2f in %s): %s", ended_, goal_->pose.position.x, goal_->pose.position.y,
           goal_->header.frame_id.c_str(), how);
  goal_.reset();
  driven_to_.reset();
  driver_.dropGoal();
}

std::optional<ScriptedTeleoperator::Localised> ScriptedTeleoperator::lookUp(const std::string& target,
                                                                            const std::string& source) const {
  try {
    const geometry_msgs::TransformStamped found = tf_.lookupTransform(target, frameName(source), ros::Time());
    return Localised{fromMessage(found.transform), found.header.stamp.toSec()};
  } catch (const tf2::TransformException& error) {
    ROS_WARN_THROTTLE(kWarnPeriod, "the driver stands still: %s", error.what());
    return std::nullopt;
  }
}

std::optional<ScriptedTeleoperator::Localised> ScriptedTeleoperator::localise() const {
  if (truth_subscriber_.getNumPublishers() == 0) return lookUp(parameters_.map_frame, parameters_.base_frame);
  if (truth_.empty()) return std::nullopt;
  return Localised{truth_.newest().pose, truth_.newest().stamp};
}

std::optional<Point2> ScriptedTeleoperator::goalInMap() const {
  const Pose2 goal = fromMessage(goal_->pose);
  const std::string frame = frameName(goal_->header.frame_id);
  if (frame == parameters_.map_frame) return Point2{goal.x, goal.y};
  Pose2 frame_in_map;
  if (truth_.empty()) {
    const std::optional<Localised> found = lookUp(parameters_.map_frame, frame);
    if (!found) return std::nullopt;
    frame_in_map = found->pose;
  } else {
    // Where odometry says that the base is, and where it truly was at that moment, tell where odometry's origin is.
    const std::optional<Localised> base = lookUp(frame, parameters_.base_frame);
    if (!base || base->stamp > truth_.newest().stamp) return driven_to_;
    frame_in_map = compose(truth_.poseAt(base->stamp), inverse(base->pose));
  }
  return toParentFrame(frame_in_map, {goal.x, goal.y});
}

Twist2 ScriptedTeleoperator::steer() {
  const double now = ros::Time::now().toSec();
  const std::optional<Localised> base = localise();
  if (!base || now - base->stamp > parameters_.patience) {
    ROS_WARN_THROTTLE(kWarnPeriod, "the driver stands still: it does not know where the robot is");
    return kStanding;
  }
  const std::optional<Point2> goal = goalInMap();
  if (!goal || !std::isfinite(goal->x) || !std::isfinite(goal->y)) return kStanding;
  if (!driven_to_ || distanceBetween(*driven_to_, *goal) > kGoalMoved) {
    driver_.setGoal(*goal);
    driven_to_ = goal;
  }
  const Twist2 twist = driver_.command(base->pose, now);
  if (driver_.state() == ScriptedDriver::State::kArrived) endGoal("reached");
  if (driver_.state() == ScriptedDriver::State::kNoPath) {
    ++no_path_;
    endGoal("there is no path");
  }
  return goal_ && twist.linear == 0.0 && twist.angular == 0.0 ? kStanding : twist;
}

void ScriptedTeleoperator::onTimer(const ros::TimerEvent&) {
  if (isDone()) return;
  if (!goal_ && !parameters_.waypoints.empty()) chooseWaypoint();
  if (goal_ && parameters_.waypoints.empty() && goal_subscriber_.getNumPublishers() == 0) endGoal("withdrawn");
  const Twist2 twist = goal_ ? steer() : Twist2();
  // Who has nothing to do keeps quiet, so that somebody else may drive.
  if (goal_ || moving_) publish(twist);
}

void ScriptedTeleoperator::publish(const Twist2& twist) {
  geometry_msgs::Twist message;
  message.linear.x = twist.linear;
  message.angular.z = twist.angular;
  command_publisher_.publish(message);
  moving_ = twist.linear != 0.0 || twist.angular != 0.0;
}

}  // namespace

}  // namespace lstm_planner

int main(int argc, char** argv) {
  using namespace lstm_planner;
  // The robot is told to stop at the end.
  return runUntilStopped(argc, argv, "scripted_teleoperator", [](const ros::NodeHandle& node, const auto& stop) {
    return ScriptedTeleoperator(loadTeleoperatorParameters(node)).run(stop);
  });
}
