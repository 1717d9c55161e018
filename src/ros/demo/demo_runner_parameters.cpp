#include <stdexcept>
#include <utility>

#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"
#include "lstm_planner/ros/demo/demo_runner.hpp"
#include "ros/common/parameter_value.hpp"

namespace lstm_planner {
namespace {

constexpr double kLongest = 86400.0;  // s

DemoParameters::Goal readGoal(XmlRpc::XmlRpcValue value, const std::string& name, std::size_t number,
                              double time_limit) {
  using XmlRpc::XmlRpcValue;
  DemoParameters::Goal goal{std::to_string(number), poseFromParameter(value, name), time_limit};
  if (value.getType() != XmlRpcValue::TypeStruct) return goal;
  if (value.hasMember("name")) goal.name += " " + asText(value["name"]).value_or("");
  if (value.hasMember("time_limit")) {
    const auto limit = asNumber(value["time_limit"]);
    if (!limit) throw std::invalid_argument(name + "/time_limit is not a number");
    goal.time_limit = *limit;
    checkRange(name + "/time_limit", goal.time_limit, 0.1, kLongest);
  }
  return goal;
}

Pose2 fromOdometryFrame(const Pose2& start, const Pose2& pose) {
  const Point2 position = toParentFrame(start, Point2{pose.x, pose.y});
  return {position.x, position.y, normalizeAngle(start.yaw + pose.yaw)};
}

void readGoals(const ros::NodeHandle& node, const std::string& frame, double time_limit, DemoParameters* parameters) {
  const std::string name = node.resolveName("scenario/goals");
  XmlRpc::XmlRpcValue list;
  if (!node.getParam("scenario/goals", list) || list.getType() != XmlRpc::XmlRpcValue::TypeArray || list.size() == 0) {
    throw std::invalid_argument("parameter " + name + " is not a list of goals (is the goals file loaded?)");
  }
  for (int i = 0; i < list.size(); ++i) {
    const auto number = static_cast<std::size_t>(i + 1);
    parameters->goals.push_back(readGoal(list[i], name + "[" + std::to_string(i) + "]", number, time_limit));
    Pose2& pose = parameters->goals.back().pose;
    if (frame == "odom") pose = fromOdometryFrame(parameters->start, pose);
  }
}

}  // namespace

DemoParameters loadDemoParameters(const ros::NodeHandle& private_node) {
  DemoParameters parameters;
  ParameterReader reader(private_node);
  visitDemoParameters(parameters, reader.visitor());
  visitDemoParameters(std::as_const(parameters), RangeCheck{private_node.getNamespace() + "/"});
  reader.know("start");
  reader.knowGroup("scenario");
  reader.warnOfUnknown();

  reader.read(reader.isSet("start") ? "start" : "scenario/start", &parameters.start);
  std::string frame = "map";
  reader.read("scenario/frame", &frame);
  if (frame != "map" && frame != "odom") {
    throw std::invalid_argument("parameter " + private_node.resolveName("scenario/frame") + " is '" + frame +
                                "', expected map or odom");
  }
  double time_limit = 300.0;
  reader.read("scenario/time_limit", &time_limit);
  checkRange(private_node.resolveName("scenario/time_limit"), time_limit, 0.1, kLongest);
  readGoals(private_node, frame, time_limit, &parameters);
  return parameters;
}

}  // namespace lstm_planner
