#pragma once

#include <cstdint>
#include <string>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/simulation/create2.hpp"
#include "lstm_planner/simulation/hokuyo.hpp"

namespace lstm_planner {

/// What `create2_stub` reads from its private namespace; config/create2_stub.yaml explains every parameter.
struct Create2StubParameters {
  // The driver, under the names and with the defaults of create_driver.
  std::string base_frame = "base_footprint";
  std::string odom_frame = "odom";
  std::string robot_model = "CREATE_2";
  double latch_cmd_duration = 0.2;
  double loop_hz = 10.0;
  bool publish_tf = true;

  // The world: a map_server map or circles, exactly one of them.
  std::string map;
  double free_threshold = -1.0;
  std::string circles;
  double circle_radius = 0.075;
  int circle_world = 1;
  std::string map_frame = "map";
  bool publish_map = false;
  double localisation_jump = 0.0;
  Pose2 start;
  std::string others;

  // The robot and its scanner.
  Create2Parameters robot;
  HokuyoParameters laser = swept();
  std::string laser_frame = "laser";
  double laser_height = 0.125;
  double base_link_height = 0.017;
  bool has_second_laser = false;
  HokuyoParameters second_laser = swept(lookingBack());
  std::string second_laser_frame = "second_laser";
  double second_laser_height = 0.125;
  bool publish_static_tf = true;
  std::uint64_t seed = 1;
  Pose2 odometry_jump{1.0, 0.0, 0.0};

  // Time.
  bool publish_clock = false;
  double real_time_factor = 1.0;
  double command_period = 0.0;
  double command_patience = 0.5;
};

/// Visits every parameter; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitCreate2StubParameters(Parameters& stub, const Visitor& visit) {
  visit("base_frame", stub.base_frame, {}, "", "of the robot");
  visit("odom_frame", stub.odom_frame, {}, "", "of the odometry");
  visit("robot_model", stub.robot_model, {}, "", "CREATE_2, the only simulated model");
  visit("latch_cmd_duration", stub.latch_cmd_duration, {0.0, 60.0}, "s",
        "time without a command after which the robot is stopped");
  visit("loop_hz", stub.loop_hz, {0.1, 100.0}, "Hz", "of odometry, tf and everything else the driver publishes");
  visit("publish_tf", stub.publish_tf, {}, "", "odom_frame -> base_frame");

  visit("map", stub.map, {}, "", "path of a map_server yaml; this or circles");
  visit("free_threshold", stub.free_threshold, {-1.0, 1.0}, "", "replaces the map's free_thresh if it is not negative");
  visit("circles", stub.circles, {}, "", "path of a csv with the columns x, y and optionally radius and world");
  visit("circle_radius", stub.circle_radius, {0.001, 100.0}, "m",
        "radius of the circles, if there is no column radius");
  visit("circle_world", stub.circle_world, {}, "", "the world to load, if there is a column world");
  visit("map_frame", stub.map_frame, {}, "", "of the map and of ~ground_truth");
  visit("publish_map", stub.publish_map, {}, "", "publishes the map, and the transform map_frame -> odom_frame");
  visit("localisation_jump", stub.localisation_jump, {0.0, 10.0}, "m",
        "with publish_map: that transform is corrected when the error of odometry reaches this; 0: it is constant");
  visit("start", stub.start, {}, "m, m, rad", "of the robot, in the map frame");

  visit("others", stub.others, {}, "",
        "~ground_truth topics of other robots, separated by spaces; they are as large as this one, which sees them and "
        "can touch them");

  visitCreate2Parameters(stub.robot, withPrefix("robot/", visit));
  visit("base_link_height", stub.base_link_height, {-100.0, 100.0}, "m", "above base_frame");
  visit("odometry_jump", stub.odometry_jump, {}, "m, m, rad",
        "the service ~jump_odometry adds this, in the base frame");
  visitHokuyoParameters(stub.laser, withPrefix("laser/", visit));
  visit("laser/frame", stub.laser_frame, {}, "", "frame of the scans");
  visit("laser/z", stub.laser_height, {-100.0, 100.0}, "m", "above base_link");
  visit("laser/upside_down", stub.laser.mount.upside_down, {}, "", "mirrors the order of the beams");
  visit("second_laser/is_mounted", stub.has_second_laser, {}, "", "there is a second scanner; topic second_scan");
  visitHokuyoParameters(stub.second_laser, withPrefix("second_laser/", visit));
  visit("second_laser/frame", stub.second_laser_frame, {}, "", "frame of its scans");
  visit("second_laser/z", stub.second_laser_height, {-100.0, 100.0}, "m", "above base_link");
  visit("second_laser/upside_down", stub.second_laser.mount.upside_down, {}, "", "mirrors the order of its beams");
  visit("publish_static_tf", stub.publish_static_tf, {}, "", "base_frame -> base_link -> laser, second_laser");

  visit("seed", stub.seed, {}, "", "of noise, drop-outs and slip");
  visit("publish_clock", stub.publish_clock, {}, "", "the stub publishes /clock");
  visit("real_time_factor", stub.real_time_factor, {0.001, 100.0}, "",
        "simulated seconds per second, with publish_clock; the other nodes must be fast enough");
  visit("command_period", stub.command_period, {0.0, 60.0}, "s",
        "simulated time without a command after which the clock waits for the controller; 0: it never waits");
  visit("command_patience", stub.command_patience, {0.0, 60.0}, "s",
        "longest wait for the controller, in the computer's time");
}

}  // namespace lstm_planner
