#include "lstm_planner/ros/common/pose_parameter.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace lstm_planner {
namespace {

using XmlRpc::XmlRpcValue;

double numberOf(XmlRpcValue value) {
  if (value.getType() == XmlRpcValue::TypeDouble) return static_cast<double&>(value);
  if (value.getType() == XmlRpcValue::TypeInt) return static_cast<int&>(value);
  return std::numeric_limits<double>::quiet_NaN();
}

/// The numbers of a pose in order; none or NaN when the value is something else.
std::vector<double> numbersOf(XmlRpcValue value) {
  std::vector<double> numbers;
  if (value.getType() == XmlRpcValue::TypeString) {
    std::istringstream text(static_cast<std::string&>(value));
    for (double number; text >> number;) numbers.push_back(number);
    if (!text.eof()) numbers.clear();
  } else if (value.getType() == XmlRpcValue::TypeArray) {
    for (int i = 0; i < value.size(); ++i) numbers.push_back(numberOf(value[i]));
  } else if (value.getType() == XmlRpcValue::TypeStruct && value.hasMember("x") && value.hasMember("y")) {
    numbers = {numberOf(value["x"]), numberOf(value["y"])};
    if (value.hasMember("yaw")) numbers.push_back(numberOf(value["yaw"]));
  }
  return numbers;
}

}  // namespace

Pose2 poseFromParameter(const XmlRpcValue& value, const std::string& name) {
  const std::vector<double> numbers = numbersOf(value);
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
  if (value.getType() == XmlRpcValue::TypeStruct && value.hasMember("name") &&
      value["name"].getType() == XmlRpcValue::TypeString) {
    named.name = static_cast<std::string&>(value["name"]);
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
