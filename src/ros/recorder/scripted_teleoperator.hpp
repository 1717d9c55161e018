#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <tf2_ros/buffer.h>

#include <csignal>
#include <optional>
#include <string>

#include "lstm_planner/drive/perception/odometry_history.hpp"
#include "lstm_planner/ros/common/transform_listener.hpp"
#include "lstm_planner/ros/recorder/teleoperator_parameters.hpp"
#include "lstm_planner/simulation/world.hpp"

namespace lstm_planner {

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

}  // namespace lstm_planner
