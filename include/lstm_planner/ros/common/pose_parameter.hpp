#pragma once

#include <ros/node_handle.h>

#include <string>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// A place with a name, such as a waypoint of a list.
struct NamedPose {
  std::string name;
  Pose2 pose;
};

/// A pose (m, m, rad) from a list [x, y, yaw], a string "x y yaw" or a struct {x: , y: , yaw: }; the yaw may be left
/// out. Throws std::invalid_argument that calls the value by `name`.
Pose2 poseFromParameter(const XmlRpc::XmlRpcValue& value, const std::string& name);

/// The same for place `number` of the list `name`: a struct may have a `name`, which else is its number.
NamedPose namedPoseFromParameter(XmlRpc::XmlRpcValue value, const std::string& name, int number);

/// The same for a parameter of the node's namespace; leaves `pose` alone and returns false when it is not set.
bool readPose(const ros::NodeHandle& node, const std::string& name, Pose2* pose);

}  // namespace lstm_planner
