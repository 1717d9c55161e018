#pragma once

#include <ros/node_handle.h>

#include <cstdint>
#include <string>

#include "lstm_planner/base/common/geometry.hpp"
#include "lstm_planner/robot/simulation/create2.hpp"
#include "lstm_planner/robot/simulation/hokuyo.hpp"

namespace lstm_planner {

/// What `create2_stub` reads from its private namespace; config/create2_stub.yaml explains every parameter.
struct Create2StubParameters {
  // The driver, under the names and with the defaults of create_driver.
  std::string base_frame = "base_footprint";
  std::string odom_frame = "odom";
  std::string robot_model = "CREATE_2";
  double latch_cmd_duration = 0.2;  ///< s
  double loop_hz = 10.0;
  bool publish_tf = true;

  // The world: a map_server map or circles, exactly one of them.
  std::string map;               ///< path of the map's yaml
  double free_threshold = -1.0;  ///< replaces the map's free_thresh when not negative
  std::string circles;           ///< path of a csv with the columns x, y and optionally radius and world
  double circle_radius = 0.075;  ///< m, of circles without a column radius
  int circle_world = 1;          ///< which circles are meant where there is a column world
  std::string map_frame = "map";
  bool publish_map = false;  ///< the map on `map` and the transform map_frame -> odom_frame, for viewing and for tests
  Pose2 start;               ///< in the map frame

  // The robot and its scanner.
  Create2Parameters robot;
  HokuyoParameters laser;
  std::string laser_frame = "laser";
  double laser_height = 0.125;      ///< m above base_link
  double base_link_height = 0.017;  ///< m above base_frame
  bool publish_static_tf = true;    ///< base_frame -> base_link -> laser_frame
  std::uint64_t seed = 1;
  Pose2 odometry_jump{1.0, 0.0, 0.0};  ///< what ~jump_odometry adds, in the base frame

  // Time.
  bool publish_clock = false;     ///< the stub drives /clock
  double real_time_factor = 1.0;  ///< simulated seconds a second while it does
  double command_period = 0.0;    ///< s of simulated time after which it waits for a controller at work; 0: it never does
  double command_patience = 0.5;  ///< s of the computer's time that it waits at most
};

/// Reads all parameters from the node's private namespace; what is not set keeps its default. Throws
/// std::invalid_argument naming the parameter, its value and what was expected.
Create2StubParameters loadCreate2StubParameters(const ros::NodeHandle& private_node);

}  // namespace lstm_planner
