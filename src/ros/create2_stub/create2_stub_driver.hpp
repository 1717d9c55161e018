#pragma once

#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Empty.h>
#include <tf2_ros/transform_broadcaster.h>

#include <functional>
#include <string>
#include <vector>

#include "lstm_planner/simulation/create2_stub_parameters.hpp"
#include "ros/create2_stub/create2_stub_world.hpp"

namespace lstm_planner {

/// What create_driver shows to ROS, over a simulated robot: the same topics, frames, queue sizes and habits. As in the
/// driver, messages are received in the loop, after it has published and looked at the latch; so a command waits up to
/// one period and the robot stops 0.2 to 0.3 s after the last one.
class Create2StubDriver {
 public:
  /// `now` gives the time for stamps.
  Create2StubDriver(const Create2StubParameters& parameters, RobotInWorld* robot, std::function<ros::Time()> now);

  /// One round of the driver's loop at `time`.
  void update(const ros::Time& time);

  /// A packet of the base's encoders; the driver's velocities are differences between packets.
  void readEncoders(double seconds_since_last);

  /// Moves the odometry (not the robot) by `jump`, given in the base frame.
  void jumpOdometry(const Pose2& jump);

  /// What it publishes.
  Pose2 odometry() const;

 private:
  void onCommand(const geometry_msgs::Twist::ConstPtr& message);
  void drive(const Twist2& twist);
  void publishOdometry();
  void publishJointStates();
  void publishBattery();
  void publishSensors();
  void publishDiagnostics();

  Create2StubParameters parameters_;
  RobotInWorld* robot_;
  std::function<ros::Time()> now_;

  Pose2 odometry_offset_;
  Twist2 measured_;
  double left_angle_ = 0.0;
  double right_angle_ = 0.0;
  double requested_left_ = 0.0;   ///< m/s
  double requested_right_ = 0.0;  ///< m/s
  ros::Time time_;                ///< of the loop
  ros::Time last_command_;
  ros::Time next_diagnostics_;
  bool passive_ = false;  ///< docking; drive commands are ignored until `undock`

  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  std::vector<ros::Subscriber> subscribers_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher odometry_publisher_;
  ros::Publisher joints_publisher_;
  ros::Publisher diagnostics_publisher_;
  ros::Publisher omni_publisher_;
  ros::Publisher mode_publisher_;
  ros::Publisher bumper_publisher_;
  ros::Publisher charging_publisher_;
  std::vector<ros::Publisher> battery_publishers_;
  std::vector<ros::Publisher> silent_publishers_;  ///< topics that speak only when a button is pressed or a wheel drops
  nav_msgs::Odometry odometry_message_;
  sensor_msgs::JointState joints_message_;
};

}  // namespace lstm_planner
