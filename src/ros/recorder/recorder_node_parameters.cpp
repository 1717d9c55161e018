#include "lstm_planner/ros/recorder/recorder_node_parameters.hpp"

#include <array>
#include <cstdlib>
#include <stdexcept>

#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "lstm_planner/ros/common/pose_parameter.hpp"

namespace lstm_planner {

namespace {

using XmlRpc::XmlRpcValue;

/// Of the agent only what the recorder's look back needs is a parameter here.
void readRecorder(ParameterReader* reader, RecorderParameters* recorder) {
  visitRecorderNumbers(*recorder, reader->numbers());
  readScanRules(reader, &recorder->scan_rules);
  reader->read("keep_scans", &recorder->keep_scans);
  reader->read("action_angles", &recorder->action_angles);
  reader->read("step/length", &recorder->agent.step.length);
  reader->read("shield/footprint_radius", &recorder->agent.shield.footprint_radius);
  reader->read("goal_drift", &recorder->agent.goal_drift);
  reader->read("memory/enabled", &recorder->agent.memory.enabled);
  reader->read("memory/width", &recorder->agent.memory.width);
  reader->read("memory/resolution", &recorder->agent.memory.resolution);
  reader->read("memory/reach", &recorder->agent.memory.reach);
}

RecorderNodeParameters::WayPoint wayPointFrom(XmlRpcValue value, std::size_t i) {
  const std::string number = std::to_string(i);
  RecorderNodeParameters::WayPoint way_point{number, poseFromParameter(value, "parameter way_points[" + number + "]")};
  if (value.getType() == XmlRpcValue::TypeStruct && value.hasMember("name") &&
      value["name"].getType() == XmlRpcValue::TypeString) {
    way_point.name = static_cast<std::string&>(value["name"]);
  }
  return way_point;
}

}  // namespace

void readParameters(ParameterReader* reader, RecorderNodeParameters* parameters) {
  reader->read("output", &parameters->output);
  reader->read("scan_topic", &parameters->scan_topic);
  reader->read("odom_topic", &parameters->odom_topic);
  reader->read("base_frame", &parameters->base_frame);
  reader->read("way_point_frame", &parameters->way_point_frame);
  reader->read("seed", &parameters->seed);
  reader->read("disk_low", &parameters->disk_low);
  readRecorder(reader, &parameters->recorder);

  std::vector<XmlRpcValue> list;
  reader->read("way_points", &list);
  for (std::size_t i = 0; i < list.size(); ++i) parameters->way_points.push_back(wayPointFrom(list[i], i));
}

RecorderNodeParameters loadRecorderNodeParameters(const ros::NodeHandle& node_handle) {
  RecorderNodeParameters parameters;
  ParameterReader reader(node_handle);
  readParameters(&reader, &parameters);
  reader.warnOfUnknown();

  validate(parameters.recorder);
  checkParameter(parameters.way_points.size() != 1, "way_points", 1.0, "a list of none or of at least two");
  checkRange("disk_low", parameters.disk_low, 0.0, 1e9);
  if (parameters.way_point_frame.empty()) {
    throw std::invalid_argument("parameter way_point_frame is empty, expected the frame of the way-points");
  }
  outputPath(parameters.output, std::time(nullptr));
  return parameters;
}

std::string outputPath(const std::string& output, std::time_t now) {
  std::array<char, 4096> text{};
  std::tm utc{};
  gmtime_r(&now, &utc);
  if (output.empty() || std::strftime(text.data(), text.size(), output.c_str(), &utc) == 0) {
    throw std::invalid_argument("parameter output is '" + output + "', expected the path of a file");
  }
  std::string path = resolvePackagePath(text.data());
  if (path == "~" || path.compare(0, 2, "~/") == 0) {
    const char* home = std::getenv("HOME");
    if (home == nullptr) {
      throw std::invalid_argument("parameter output is '" + output + "', but the environment has no HOME");
    }
    path.replace(0, 1, home);
  }
  if (path.back() == '/') {
    throw std::invalid_argument("parameter output is '" + output + "', a folder, expected the path of a file");
  }
  return path;
}

}  // namespace lstm_planner
