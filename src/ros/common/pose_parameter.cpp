#include "lstm_planner/ros/common/pose_parameter.hpp"

#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "ros/common/parameter_value.hpp"

namespace lstm_planner {
namespace {

using XmlRpc::XmlRpcValue;

/// The numbers of a pose in order; nothing when the value is something else.
std::optional<std::vector<double>> coordinatesOf(XmlRpcValue value) {
  if (value.getType() != XmlRpcValue::TypeStruct) return asNumbers(value);
  XmlRpcValue list;
  int count = 0;
  for (const char* name : {"x", "y", "yaw"}) {
    if (value.hasMember(name)) list[count++] = value[name];
  }
  return value.hasMember("x") && value.hasMember("y") ? asNumbers(list) : std::nullopt;
}

}  // namespace

Pose2 poseFromParameter(const XmlRpcValue& value, const std::string& name) {
  const std::vector<double> numbers = coordinatesOf(value).value_or(std::vector<double>());
  if (numbers.size() == 2 || numbers.size() == 3) {
    const Pose2 pose{numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : 0.0};
    if (isFinite(pose)) return pose;
  }
  std::ostringstream text;
  text << name << " is " << value << ", expected a pose: [x, y, yaw], \"x y yaw\" or {x: , y: , yaw: } in m and rad";
  throw std::invalid_argument(text.str());
}

NamedPose namedPoseFromParameter(XmlRpcValue value, const std::string& name, int number) {
  const std::string place = std::to_string(number);
  NamedPose named{place, poseFromParameter(value, "parameter " + name + "[" + place + "]")};
  if (value.getType() == XmlRpcValue::TypeStruct && value.hasMember("name")) {
    named.name = asText(value["name"]).value_or(place);
  }
  return named;
}

bool readPose(const ros::NodeHandle& node, const std::string& name, Pose2* pose) {
  XmlRpcValue value;
  if (!node.getParam(name, value)) return false;
  *pose = poseFromParameter(value, "parameter " + node.resolveName(name));
  return true;
}

}  // namespace lstm_planner
