#include "lstm_planner/ros/create2_stub/create2_stub_parameters.hpp"

#include <ros/console.h>

#include <stdexcept>

#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"
#include "lstm_planner/ros/common/pose_parameter.hpp"

namespace lstm_planner {
namespace {

/// Poses and what belongs to the demo runner do not go through the reader.
bool isReadElsewhere(const ros::NodeHandle& node, const std::string& full_name) {
  const std::string name = full_name.substr(node.getNamespace().size() + 1);
  return name == "start" || name == "odometry_jump" || name.rfind("scenario/", 0) == 0;
}

void readLaser(ParameterReader* reader, Create2StubParameters* parameters) {
  visitHokuyoNumbers(parameters->laser, reader->numbers("laser/"));
  reader->read("laser/z", &parameters->laser_height);
  reader->read("laser/upside_down", &parameters->laser.mount.upside_down);
  reader->read("laser/frame", &parameters->laser_frame);
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

  visitCreate2Numbers(parameters.robot, reader.numbers("robot/"));
  visitCreate2Numbers(parameters.robot, RangeCheck{private_node.resolveName("robot") + "/"});
  validate(parameters.robot);
  readLaser(&reader, &parameters);
  visitHokuyoNumbers(parameters.laser, RangeCheck{private_node.resolveName("laser") + "/"});
  validate(parameters.laser);
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
  const auto check = [&](const std::string& name, double value, double least, double most) {
    checkRange(private_node.resolveName(name), value, least, most);
  };
  check("latch_cmd_duration", parameters.latch_cmd_duration, 0.0, 60.0);
  check("loop_hz", parameters.loop_hz, 0.1, 100.0);
  check("laser/rate", parameters.laser.rate, 0.1, 200.0);
  check("laser/z", parameters.laser_height, -100.0, 100.0);
  check("base_link_height", parameters.base_link_height, -100.0, 100.0);
  check("free_threshold", parameters.free_threshold, -1.0, 1.0);
  check("circle_radius", parameters.circle_radius, 0.001, 100.0);
  check("real_time_factor", parameters.real_time_factor, 0.001, 100.0);  // so that the other nodes can keep up
  check("command_period", parameters.command_period, 0.0, 60.0);
  check("command_patience", parameters.command_patience, 0.0, 60.0);
  for (const std::string& name : reader.unknownParameters()) {
    if (!isReadElsewhere(private_node, name)) ROS_WARN("parameter %s is not known and has no effect", name.c_str());
  }
  return parameters;
}

}  // namespace lstm_planner
