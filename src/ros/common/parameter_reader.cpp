#include "lstm_planner/ros/common/parameter_reader.hpp"

#include <ros/console.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "lstm_planner/drive/plugin_parameters.hpp"
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

/// Place `number` of the list `name`.
NamedPose namedPoseFromParameter(XmlRpcValue value, const std::string& name, int number) {
  const std::string place = std::to_string(number);
  NamedPose named{place, poseFromParameter(value, "parameter " + name + "[" + place + "]")};
  if (value.getType() == XmlRpcValue::TypeStruct && value.hasMember("name")) {
    named.name = asText(value["name"]).value_or(place);
  }
  return named;
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

bool ParameterReader::isSet(const std::string& name) {
  know(name);
  return node_handle_.hasParam(name);
}

void ParameterReader::know(const std::string& name) { known_.insert(node_handle_.resolveName(name)); }

void ParameterReader::knowGroup(const std::string& name) {
  const std::string prefix = node_handle_.resolveName(name) + "/";
  for (const std::string& unknown : unknownParameters()) {
    if (unknown.compare(0, prefix.size(), prefix) == 0) known_.insert(unknown);
  }
}

void ParameterReader::knowRobotFile() {
  for (const char* group :
       {"LstmGlobalPlanner", "SteeringController", "global_costmap", "local_costmap", "create2_stub"}) {
    knowGroup(group);
  }
}

template <typename T, typename Convert>
void ParameterReader::readAs(const std::string& name, const char* type, const Convert& convert, T* value) {
  XmlRpcValue set;
  if (!isSet(name) || !node_handle_.getParam(name, set)) return;
  const std::optional<T> converted = convert(set);
  if (!converted) {
    std::ostringstream text;
    text << "parameter " << node_handle_.resolveName(name) << " is " << set << ", expected " << type;
    throw std::invalid_argument(text.str());
  }
  *value = *converted;
}

void ParameterReader::read(const std::string& name, double* value) { readAs(name, "a number", asNumber, value); }

void ParameterReader::read(const std::string& name, int* value) {
  readAs(name, "a whole number", asWholeNumber, value);
}

void ParameterReader::read(const std::string& name, bool* value) { readAs(name, "true or false", asTruth, value); }

void ParameterReader::read(const std::string& name, std::string* value) {
  readAs(name, "a text, a number or a list of them", asText, value);
}

void ParameterReader::read(const std::string& name, std::vector<double>* value) {
  readAs(name, "a list of numbers", asNumbers, value);
}

void ParameterReader::read(const std::string& name, std::uint64_t* seed) {
  int number = static_cast<int>(*seed);
  read(name, &number);
  *seed = static_cast<std::uint64_t>(number);
}

void ParameterReader::read(const std::string& name, Pose2* pose) {
  XmlRpcValue value;
  if (!isSet(name) || !node_handle_.getParam(name, value)) return;
  *pose = poseFromParameter(value, "parameter " + node_handle_.resolveName(name));
}

void ParameterReader::read(const std::string& name, std::vector<NamedPose>* poses) {
  if (!isSet(name)) return;
  XmlRpcValue list;
  if (!node_handle_.getParam(name, list) || list.getType() != XmlRpcValue::TypeArray) {
    std::ostringstream text;
    text << "parameter " << node_handle_.resolveName(name) << " is " << list
         << ", expected a list of poses, set by a yaml or rosparam: behind _" << name << ":= it is a text";
    throw std::invalid_argument(text.str());
  }
  poses->clear();
  for (int i = 0; i < list.size(); ++i) poses->push_back(namedPoseFromParameter(list[i], name, i));
}

std::vector<std::string> ParameterReader::unknownParameters() const {
  std::vector<std::string> names;
  node_handle_.getParamNames(names);
  const std::string prefix = node_handle_.getNamespace() + "/";
  std::vector<std::string> unknown;
  for (const std::string& name : names) {
    if (name.compare(0, prefix.size(), prefix) == 0 && known_.count(name) == 0) {
      unknown.push_back(name);
    }
  }
  std::sort(unknown.begin(), unknown.end());
  return unknown;
}

std::vector<std::string> ParameterReader::warningsOfUnknown() const {
  const std::size_t prefix = node_handle_.getNamespace().size() + 1;
  std::vector<std::string> names;
  for (const std::string& name : known_) {
    if (name.size() > prefix) names.push_back(name.substr(prefix));  // some may be remapped to another namespace
  }
  std::vector<std::string> warnings;
  for (const std::string& name : unknownParameters()) {
    warnings.push_back("parameter " + name + " is set, but there is none of that name" +
                       hintAtParameter(name.substr(prefix), names));
  }
  return warnings;
}

void ParameterReader::warnOfUnknown() const {
  for (const std::string& warning : warningsOfUnknown()) ROS_WARN("%s", warning.c_str());
}

}  // namespace lstm_planner
