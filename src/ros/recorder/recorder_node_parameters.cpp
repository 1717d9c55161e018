#include "lstm_planner/ros/recorder/recorder_node_parameters.hpp"

#include <ros/this_node.h>

#include <algorithm>
#include <array>
#include <regex>
#include <stdexcept>

#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/ros/common/plugin_parameters.hpp"

namespace lstm_planner {

namespace {

/// What a robot's file tells the planner of the robot and its sensors.
void readRobotFile(const ros::NodeHandle& node_handle, RecorderNodeParameters* parameters) {
  ParameterReader reader(ros::NodeHandle(node_handle, "LstmGlobalPlanner"));
  const auto read = reader.visitor();
  visitRecorderNodeParameters(
      *parameters, onlyNamed({"scan_topic", "odom_topic", "max_speed", "no_return", "least_measured", "step/length",
                              "shield/footprint_radius", "shield/footprint", "goal_drift", "memory/enabled",
                              "memory/width", "memory/resolution", "memory/reach"},
                             read));
}

/// Robots that one launch file starts in the same second have namespaces: for /robot1 "_robot1".
std::string withNamespace(const std::string& output) {
  std::string name = ros::this_node::getNamespace();
  if (name == "/") name.clear();
  std::replace(name.begin(), name.end(), '/', '_');
  return std::regex_replace(output, std::regex("\\{namespace\\}"), name);
}

}  // namespace

RecorderNodeParameters loadRecorderNodeParameters(const ros::NodeHandle& node_handle) {
  RecorderNodeParameters parameters;
  ParameterReader reader(node_handle);
  visitRecorderNodeParameters(parameters, reader.visitor());
  reader.knowRobotFile();
  reader.warnOfUnknown();
  readRobotFile(node_handle, &parameters);

  parameters.recorder.agent = fittedToFootprint(parameters.recorder.agent);
  validate(parameters.recorder);
  checkParameter(parameters.waypoints.size() != 1, "waypoints", 1.0, "a list of none or of at least two");
  if (parameters.waypoint_frame.empty()) {
    throw std::invalid_argument("parameter waypoint_frame is empty, expected the frame of the waypoints");
  }
  outputPath(parameters.output, std::time(nullptr));
  return parameters;
}

std::string outputPath(const std::string& output, std::time_t now) {
  std::array<char, 4096> text{};
  std::tm utc{};
  gmtime_r(&now, &utc);
  if (output.empty() || std::strftime(text.data(), text.size(), withNamespace(output).c_str(), &utc) == 0) {
    throw std::invalid_argument("parameter output is '" + output + "', expected the path of a file");
  }
  const std::string path = resolvedPath(text.data());
  if (path.back() == '/') {
    throw std::invalid_argument("parameter output is '" + output + "', a folder, expected the path of a file");
  }
  return path;
}

}  // namespace lstm_planner
