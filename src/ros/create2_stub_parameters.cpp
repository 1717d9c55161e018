#include "lstm_planner/ros/create2_stub_parameters.hpp"

#include <ros/console.h>

#include <sstream>
#include <stdexcept>

#include "lstm_planner/ros/parameter_reader.hpp"
#include "lstm_planner/ros/pose_parameter.hpp"

namespace lstm_planner {
namespace {

void check(bool fine, const ros::NodeHandle& node, const std::string& name, double value, const std::string& expected) {
  if (fine) return;
  std::ostringstream text;
  text << "parameter " << node.resolveName(name) << " is " << value << ", expected " << expected;
  throw std::invalid_argument(text.str());
}

/// Poses and what belongs to the demo runner do not go through the reader.
bool isReadElsewhere(const ros::NodeHandle& node, const std::string& full_name) {
  const std::string name = full_name.substr(node.getNamespace().size() + 1);
  return name == "start" || name == "odometry_jump" || name.rfind("scenario/", 0) == 0;
}

void readRobot(ParameterReader* reader, Create2Parameters* robot) {
  reader->read("robot/axle_length", &robot->axle_length);
  reader->read("robot/wheel_diameter", &robot->wheel_diameter);
  reader->read("robot/ticks_per_revolution", &robot->ticks_per_revolution);
  reader->read("robot/max_wheel_speed", &robot->max_wheel_speed);
  reader->read("robot/base_diameter", &robot->base_diameter);
  reader->read("robot/max_wheel_acceleration", &robot->max_wheel_acceleration);
  reader->read("robot/slip", &robot->slip);
  reader->read("robot/drift", &robot->drift);
  reader->read("robot/odometry_error", &robot->odometry_error);
  validate(*robot);
}

void readLaser(ParameterReader* reader, Create2StubParameters* parameters) {
  HokuyoParameters& laser = parameters->laser;
  reader->read("laser/beams", &laser.beams);
  reader->read("laser/angle_min", &laser.angle_min);
  reader->read("laser/angle_increment", &laser.angle_increment);
  reader->read("laser/range_min", &laser.range_min);
  reader->read("laser/range_max", &laser.range_max);
  reader->read("laser/sight", &laser.sight);
  reader->read("laser/noise", &laser.noise);
  reader->read("laser/dropout", &laser.dropout);
  reader->read("laser/rate", &laser.rate);
  reader->read("laser/x", &laser.mount.pose.x);
  reader->read("laser/y", &laser.mount.pose.y);
  reader->read("laser/z", &parameters->laser_height);
  reader->read("laser/yaw", &laser.mount.pose.yaw);
  reader->read("laser/upside_down", &laser.mount.upside_down);
  reader->read("laser/frame", &parameters->laser_frame);
  validate(laser);
}

}  // namespace

Create2StubParameters loadCreate2StubParameters(const ros::NodeHandle& private_node) {
  ParameterReader reader(private_node);
  Create2StubParameters parameters;
  reader.read("base_frame", &parameters.base_frame);
  reader.read("odom_frame", &parameters.odom_frame);
  reader.read("robot_model", &parameters.robot_model);
  reader.read("latch_cmd_duration", &parameters.latch_cmd_duration);
  reader.read("loop_hz", &parameters.loop_hz);
  reader.read("publish_tf", &parameters.publish_tf);

  reader.read("map", &parameters.map);
  reader.read("free_threshold", &parameters.free_threshold);
  reader.read("circles", &parameters.circles);
  reader.read("circle_radius", &parameters.circle_radius);
  reader.read("circle_world", &parameters.circle_world);
  reader.read("map_frame", &parameters.map_frame);
  reader.read("publish_map", &parameters.publish_map);
  if (!readPose(private_node, "start", &parameters.start)) {
    readPose(private_node, "scenario/start", &parameters.start);
  }

  readRobot(&reader, &parameters.robot);
  readLaser(&reader, &parameters);
  reader.read("base_link_height", &parameters.base_link_height);
  reader.read("publish_static_tf", &parameters.publish_static_tf);
  int seed = 1;
  reader.read("seed", &seed);
  parameters.seed = static_cast<std::uint64_t>(seed);
  readPose(private_node, "odometry_jump", &parameters.odometry_jump);

  reader.read("publish_clock", &parameters.publish_clock);
  reader.read("real_time_factor", &parameters.real_time_factor);
  reader.read("command_period", &parameters.command_period);
  reader.read("command_patience", &parameters.command_patience);

  if (parameters.robot_model != "CREATE_2") {
    throw std::invalid_argument("parameter " + private_node.resolveName("robot_model") + " is '" +
                                parameters.robot_model + "', expected CREATE_2, the only model that is simulated");
  }
  check(parameters.latch_cmd_duration >= 0.0, private_node, "latch_cmd_duration", parameters.latch_cmd_duration,
        "0 s or more");
  check(parameters.loop_hz > 0.0 && parameters.loop_hz <= 100.0, private_node, "loop_hz", parameters.loop_hz,
        "more than 0 and at most 100 Hz");
  check(parameters.laser.rate <= 200.0, private_node, "laser/rate", parameters.laser.rate, "at most 200 Hz");
  check(parameters.circle_radius > 0.0, private_node, "circle_radius", parameters.circle_radius, "more than 0 m");
  check(parameters.real_time_factor > 0.0 && parameters.real_time_factor <= 100.0, private_node, "real_time_factor",
        parameters.real_time_factor, "more than 0 and at most 100, so that the other nodes can keep up");
  check(parameters.command_period >= 0.0, private_node, "command_period", parameters.command_period, "0 s or more");
  check(parameters.command_patience >= 0.0 && parameters.command_patience <= 60.0, private_node, "command_patience",
        parameters.command_patience, "0 to 60 s");
  for (const std::string& name : reader.unknownParameters()) {
    if (!isReadElsewhere(private_node, name)) ROS_WARN("parameter %s is not known and has no effect", name.c_str());
  }
  return parameters;
}

}  // namespace lstm_planner
