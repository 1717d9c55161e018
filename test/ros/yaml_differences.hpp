#pragma once

#include <ros/node_handle.h>

#include <set>
#include <string>
#include <vector>

#include "lstm_planner/ros/common/parameter_reader.hpp"

namespace lstm_planner {

/// How a namespace differs from a yaml file that lists every parameter with its default.
struct YamlDifferences {
  std::set<std::string> missing;  ///< names within the namespace
  std::set<std::string> changed;
  std::vector<std::string> unknown;  ///< full names
};

template <typename T>
bool isSame(const T& a, const T& b) {
  return a == b;
}
inline bool isSame(const std::vector<NamedPose>& a, const std::vector<NamedPose>& b) { return a.empty() && b.empty(); }

/// `visit_all(parameters, visitor)` visits the parameters; see parameter_visitors.hpp.
template <typename Parameters, typename VisitAll>
YamlDifferences yamlDifferences(const ros::NodeHandle& node, const VisitAll& visit_all) {
  YamlDifferences differences;
  ParameterReader reader(node);
  Parameters parameters;
  visit_all(parameters, [&](const std::string& name, auto& value, Range, const char*, const char*) {
    const auto default_value = value;
    if (!node.hasParam(name)) differences.missing.insert(name);
    reader.read(name, &value);
    if (!isSame(value, default_value)) differences.changed.insert(name);
  });
  differences.unknown = reader.unknownParameters();
  return differences;
}

}  // namespace lstm_planner
