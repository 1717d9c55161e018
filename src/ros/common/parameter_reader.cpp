#include "lstm_planner/ros/common/parameter_reader.hpp"

#include <ros/console.h>

#include <stdexcept>

namespace lstm_planner {

template <typename T>
void ParameterReader::readAs(const std::string& name, const char* type, T* value) {
  const std::string full_name = node_handle_.resolveName(name);
  known_.insert(full_name);
  if (!node_handle_.hasParam(name)) {
    unset_.insert(full_name);
    return;
  }
  const T default_value = *value;
  if (!node_handle_.getParam(name, *value)) {
    throw std::invalid_argument("parameter " + full_name + " is not " + type);
  }
  if (*value != default_value) {
    changed_.insert(full_name);
  }
}

void ParameterReader::read(const std::string& name, double* value) { readAs(name, "a number", value); }

void ParameterReader::read(const std::string& name, int* value) { readAs(name, "a whole number", value); }

void ParameterReader::read(const std::string& name, bool* value) { readAs(name, "true or false", value); }

void ParameterReader::read(const std::string& name, std::string* value) { readAs(name, "a text", value); }

void ParameterReader::read(const std::string& name, std::vector<double>* value) {
  readAs(name, "a list of numbers", value);
}

void ParameterReader::read(const std::string& name, std::vector<XmlRpc::XmlRpcValue>* value) {
  const std::string full_name = node_handle_.resolveName(name);
  known_.insert(full_name);
  XmlRpc::XmlRpcValue list;
  if (!node_handle_.getParam(name, list)) {
    unset_.insert(full_name);
    return;
  }
  if (list.getType() != XmlRpc::XmlRpcValue::TypeArray) {
    throw std::invalid_argument("parameter " + full_name + " is not a list");
  }
  std::vector<XmlRpc::XmlRpcValue> elements;
  for (int i = 0; i < list.size(); ++i) elements.push_back(list[i]);
  if (elements != *value) {
    changed_.insert(full_name);
  }
  *value = elements;
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
  return unknown;
}

void ParameterReader::warnOfUnknown() const {
  for (const std::string& name : unknownParameters()) {
    ROS_WARN("parameter %s is set, but there is none of that name", name.c_str());
  }
}

}  // namespace lstm_planner
