#include "lstm_planner/ros/demo/demo_runner.hpp"

#include <actionlib/client/simple_action_client.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <std_msgs/UInt32.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/grid/distance_field.hpp"
#include "lstm_planner/grid/map_server_map.hpp"
#include "lstm_planner/grid/occupancy_grid.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "lstm_planner/ros/common/parameter_reader.hpp"
#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "lstm_planner/simulation/trace_picture.hpp"
#include "ros/common/node_main.hpp"
#include "ros/common/parameter_value.hpp"

namespace lstm_planner {
namespace {

constexpr double kPoll = 0.02;          // s of the computer's clock
constexpr double kCancelTime = 5.0;     // s for the action to end after a cancel
constexpr double kTraceSpacing = 0.02;  // m between the points that are kept for the picture
constexpr double kNearestFree = 0.3;    // m around a blocked cell in which the shortest path may start
constexpr double kLongest = 86400.0;    // s, of the time limits
constexpr double kGridError = 1e-3;     // m, keeps rounding from closing a gap that just fits

void say(const std::string& line) { std::cout << line << std::endl; }

/// What became of one goal.
struct DemoLeg {
  std::string name;
  Point2 goal;             ///< in the map frame
  bool reached = false;    ///< the action succeeded and the robot truly is there
  std::string text;        ///< what the action said, or why the arrival is not believed
  double time = 0.0;       ///< s
  double path = 0.0;       ///< m, truly driven
  double shortest = 0.0;   ///< m, shortest path of the footprint from where the leg started; +inf where there is none
  double remaining = 0.0;  ///< m to the goal at the end
  unsigned contacts = 0;
};

std::string contactsText(unsigned contacts) {
  return std::to_string(contacts) + (contacts == 1 ? " contact" : " contacts");
}

std::string drivenText(double time, double path) {
  return fixedText(time, 1) + " s, path " + fixedText(path, 1) + " m";
}

bool hasRatio(const DemoLeg& leg) { return leg.reached && leg.shortest > 0.0 && std::isfinite(leg.shortest); }

struct Totals {
  std::size_t reached = 0;
  unsigned contacts = 0;
  double time = 0.0;
  double path = 0.0;
  double mean_ratio = 0.0;  ///< of the legs that arrived; 0 when none did
};

Totals totalsOf(const std::vector<DemoLeg>& legs) {
  Totals totals;
  std::size_t ratios = 0;
  for (const DemoLeg& leg : legs) {
    totals.reached += leg.reached ? 1 : 0;
    totals.contacts += leg.contacts;
    totals.time += leg.time;
    totals.path += leg.path;
    if (!hasRatio(leg)) continue;
    totals.mean_ratio += leg.path / leg.shortest;
    ++ratios;
  }
  if (ratios > 0) totals.mean_ratio /= static_cast<double>(ratios);
  return totals;
}

nlohmann::json toJson(const DemoLeg& leg) {
  nlohmann::json json = {{"name", leg.name},       {"x", leg.goal.x},          {"y", leg.goal.y},
                         {"reached", leg.reached}, {"text", leg.text},         {"time_s", leg.time},
                         {"path_m", leg.path},     {"contacts", leg.contacts}, {"remaining_m", leg.remaining}};
  json["shortest_m"] = std::isfinite(leg.shortest) ? nlohmann::json(leg.shortest) : nlohmann::json();
  json["ratio"] = hasRatio(leg) ? nlohmann::json(leg.path / leg.shortest) : nlohmann::json();
  return json;
}

/// "goal 2 kitchen (3.1, 4.0): reached in 31.2 s, path 9.5 m = 1.08 x shortest, 0 contacts".
std::string describeLeg(const DemoLeg& leg) {
  std::string line = "goal " + leg.name + " (" + fixedText(leg.goal.x, 1) + ", " + fixedText(leg.goal.y, 1) + "): ";
  if (leg.reached) {
    line += "reached in " + drivenText(leg.time, leg.path);
    if (hasRatio(leg)) line += " = " + fixedText(leg.path / leg.shortest, 2) + " x shortest";
  } else {
    line += "MISSED after " + drivenText(leg.time, leg.path) + ", " + fixedText(leg.remaining, 1) + " m away";
    if (!std::isfinite(leg.shortest)) line += ", no path on the map";
  }
  line += ", " + contactsText(leg.contacts);
  if (!leg.reached && !leg.text.empty()) line += " (" + leg.text + ")";
  return line;
}

/// One line for all legs of `planned` goals.
std::string describeDemo(const std::vector<DemoLeg>& legs, std::size_t planned) {
  const Totals totals = totalsOf(legs);
  std::string line = std::to_string(totals.reached) + " of " + std::to_string(planned) + " goals reached in " +
                     drivenText(totals.time, totals.path);
  if (totals.mean_ratio > 0.0) line += " = " + fixedText(totals.mean_ratio, 2) + " x shortest on average";
  return line + ", " + contactsText(totals.contacts);
}

/// 0 when every planned goal was reached and nothing was touched, else 1.
int demoExitCode(const std::vector<DemoLeg>& legs, std::size_t planned) {
  const Totals totals = totalsOf(legs);
  return totals.reached == planned && totals.contacts == 0 ? 0 : 1;
}

/// First line the exit code, then JSON: goals, reached, contacts, mean_ratio, mean_time_s, legs, error. Throws
/// std::runtime_error naming the file.
void writeDemoResult(const std::string& path, int exit_code, const std::vector<DemoLeg>& legs, std::size_t planned,
                     const std::string& error) {
  const Totals totals = totalsOf(legs);
  nlohmann::json json = {{"goals", planned},
                         {"reached", totals.reached},
                         {"contacts", totals.contacts},
                         {"mean_ratio", totals.mean_ratio},
                         {"mean_time_s", legs.empty() ? 0.0 : totals.time / static_cast<double>(legs.size())},
                         {"legs", nlohmann::json::array()}};
  for (const DemoLeg& leg : legs) json["legs"].push_back(toJson(leg));
  if (!error.empty()) json["error"] = error;
  writeOutputFile("result file", path, [&](std::ostream& file) { file << exit_code << '\n' << json.dump(2) << '\n'; });
}

/// The node `demo_runner`: sends goals one after another to a move_base action and judges, from `ground_truth`
/// (nav_msgs/Odometry in the map frame) and `contacts` (std_msgs/UInt32), what the robot made of them.
class DemoRunner {
 public:
  /// Throws MapFileError, or std::invalid_argument when a goal lies outside the map.
  explicit DemoRunner(const DemoParameters& parameters);

  /// Drives to all goals, prints a line for each and a summary, leaves result file and picture. Returns the exit code.
  int run();

 private:
  using Client = actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction>;

  void onTruth(const nav_msgs::Odometry::ConstPtr& message);
  void onContacts(const std_msgs::UInt32::ConstPtr& message);
  void driveAll();
  void waitForOthers();
  DemoLeg drive(const DemoParameters::Goal& goal);
  std::string followGoal(const DemoParameters::Goal& goal);
  bool spinUntil(double seconds, const std::function<bool()>& condition);
  void checkAlive() const;
  move_base_msgs::MoveBaseGoal message(const Pose2& goal) const;
  double shortestPath(const Point2& goal) const;
  void drawPicture() const;

  DemoParameters parameters_;
  OccupancyGrid map_;
  DistanceField distances_;
  std::vector<DemoLeg> legs_;

  Pose2 pose_;       ///< true, in the map frame
  ros::Time stamp_;  ///< of pose_; zero before the first
  ros::SteadyTime last_heard_;
  double driven_ = 0.0;  ///< m since the start
  unsigned contacts_ = 0;
  std::vector<Point2> trace_;
  std::vector<Point2> contact_points_;

  ros::NodeHandle node_;
  ros::Subscriber truth_subscriber_;
  ros::Subscriber contacts_subscriber_;
  Client client_;
};

DemoRunner::DemoRunner(const DemoParameters& parameters)
    : parameters_(parameters),
      map_(readMapServerMap(resolvedPath(parameters.map), parameters.free_threshold)),
      distances_(map_, false),
      client_(node_, parameters.action, false) {
  for (const DemoParameters::Goal& goal : parameters_.goals) {
    const Point2 position{goal.pose.x, goal.pose.y};
    if (map_.contains(map_.cellAt(position))) continue;
    std::ostringstream text;
    text << "goal " << goal.name << " (" << position.x << ", " << position.y << ") lies outside the map "
         << parameters_.map;
    throw std::invalid_argument(text.str());
  }
  truth_subscriber_ = node_.subscribe("ground_truth", 1000, &DemoRunner::onTruth, this);
  contacts_subscriber_ = node_.subscribe("contacts", 100, &DemoRunner::onContacts, this);
}

int DemoRunner::run() {
  const std::size_t planned = parameters_.goals.size();
  // Whoever reads the file after a crash must not find the result of an earlier run.
  if (!parameters_.result.empty())
    writeDemoResult(parameters_.result, 1, {}, planned, "the demo did not end by itself");
  std::string error;
  try {
    driveAll();
  } catch (const std::runtime_error& problem) {
    error = problem.what();
    say("demo: " + error);
  }
  say("demo: " + describeDemo(legs_, planned));
  if (!parameters_.picture.empty()) {
    try {
      drawPicture();
      say("demo: picture " + parameters_.picture);
    } catch (const std::runtime_error& problem) {
      error = problem.what();
      say("demo: " + error);
    }
  }
  const int exit_code = error.empty() ? demoExitCode(legs_, planned) : 1;
  if (!parameters_.result.empty()) writeDemoResult(parameters_.result, exit_code, legs_, planned, error);
  return exit_code;
}

void DemoRunner::driveAll() {
  waitForOthers();
  for (const DemoParameters::Goal& goal : parameters_.goals) {
    legs_.push_back(drive(goal));
    say("demo: " + describeLeg(legs_.back()));
  }
}

void DemoRunner::waitForOthers() {
  last_heard_ = ros::SteadyTime::now();
  if (!spinUntil(parameters_.patience, [this] { return !stamp_.isZero(); })) {
    throw std::runtime_error("nothing on the topic " + truth_subscriber_.getTopic() + ": is the simulation running?");
  }
  if (!spinUntil(parameters_.patience, [this] { return client_.isServerConnected(); })) {
    throw std::runtime_error("no server of the action " + node_.resolveName(parameters_.action) +
                             ": is move_base running?");
  }
}

bool DemoRunner::spinUntil(double seconds, const std::function<bool()>& condition) {
  const ros::SteadyTime deadline = ros::SteadyTime::now() + ros::WallDuration(seconds);
  while (ros::ok()) {
    ros::spinOnce();
    if (condition()) return true;
    if (ros::SteadyTime::now() > deadline) return false;
    ros::WallDuration(kPoll).sleep();
  }
  throw std::runtime_error("stopped from outside");
}

void DemoRunner::checkAlive() const {
  if (ros::SteadyTime::now() - last_heard_ > ros::WallDuration(parameters_.patience)) {
    throw std::runtime_error("no more ground truth: the simulation has stopped");
  }
}

DemoLeg DemoRunner::drive(const DemoParameters::Goal& goal) {
  DemoLeg leg;
  leg.name = goal.name;
  leg.goal = {goal.pose.x, goal.pose.y};
  leg.shortest = shortestPath(leg.goal);
  const ros::Time start = stamp_;
  const double driven_before = driven_;
  const unsigned contacts_before = contacts_;
  leg.text = followGoal(goal);
  leg.time = (stamp_ - start).toSec();
  leg.path = driven_ - driven_before;
  leg.contacts = contacts_ - contacts_before;
  leg.remaining = distanceBetween(pose_, leg.goal);
  leg.reached = client_.getState() == actionlib::SimpleClientGoalState::SUCCEEDED;
  if (leg.reached && leg.remaining > parameters_.arrival_radius) {
    leg.reached = false;
    leg.text = "the action succeeded, but the robot is not there";
  }
  return leg;
}

/// Returns what the action said at the end.
std::string DemoRunner::followGoal(const DemoParameters::Goal& goal) {
  const ros::Time start = stamp_;
  client_.sendGoal(message(goal.pose));
  const auto ended = [this] { return client_.getState().isDone(); };
  const auto late = [&] { return stamp_ - start > ros::Duration(goal.time_limit); };
  while (!spinUntil(1.0, [&] { return ended() || late(); })) checkAlive();
  if (ended()) return client_.getState().getText();
  client_.cancelGoal();
  const bool cancelled = spinUntil(kCancelTime, ended);
  return cancelled ? "time limit" : "time limit, and the action does not end when it is cancelled";
}

move_base_msgs::MoveBaseGoal DemoRunner::message(const Pose2& goal) const {
  const Point2 position = toLocalFrame(parameters_.start, Point2{goal.x, goal.y});
  const Pose2 pose{position.x, position.y, normalizeAngle(goal.yaw - parameters_.start.yaw)};
  move_base_msgs::MoveBaseGoal message;
  message.target_pose = toMessage(pose, parameters_.odom_frame, stamp_);
  return message;
}

double DemoRunner::shortestPath(const Point2& goal) const {
  GeodesicField::Options options;
  options.clearance = parameters_.robot_radius - kGridError;
  const GeodesicField field(map_, distances_, map_.cellAt(goal), options);
  // The robot may stand nearer to a wall than the grid can say.
  const CellIndex here = map_.cellAt({pose_.x, pose_.y});
  const int reach = static_cast<int>(std::ceil(kNearestFree / map_.resolution()));
  double shortest = std::numeric_limits<double>::infinity();
  double nearest = std::numeric_limits<double>::infinity();
  for (int row = here.row - reach; row <= here.row + reach; ++row) {
    for (int column = here.column - reach; column <= here.column + reach; ++column) {
      const double away = distanceBetween(pose_, map_.centerOf({column, row}));
      const double length = field.at({column, row});
      if (away > kNearestFree || away >= nearest || !std::isfinite(length)) continue;
      nearest = away;
      shortest = length;
    }
  }
  return shortest;
}

void DemoRunner::onTruth(const nav_msgs::Odometry::ConstPtr& message) {
  const Pose2 pose = fromMessage(message->pose.pose);
  if (!stamp_.isZero()) driven_ += distanceBetween(pose_, pose);
  pose_ = pose;
  stamp_ = message->header.stamp;
  last_heard_ = ros::SteadyTime::now();
  const Point2 position{pose.x, pose.y};
  if (trace_.empty() || distanceBetween(trace_.back(), position) >= kTraceSpacing) trace_.push_back(position);
}

void DemoRunner::onContacts(const std_msgs::UInt32::ConstPtr& message) {
  if (message->data > contacts_) contact_points_.push_back({pose_.x, pose_.y});
  contacts_ = message->data;
}

void DemoRunner::drawPicture() const {
  TracePicture picture;
  picture.robot_radius = parameters_.robot_radius;
  picture.traces = {trace_};
  picture.starts = {parameters_.start};
  picture.contacts = contact_points_;
  for (std::size_t i = 0; i < parameters_.goals.size(); ++i) {
    const DemoParameters::Goal& goal = parameters_.goals[i];
    const bool reached = i < legs_.size() && legs_[i].reached;
    picture.goals.push_back({{goal.pose.x, goal.pose.y}, goal.name, reached});
  }
  writeTracePicture(parameters_.picture, map_, picture);
}

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
    if (frame == "odom") pose = compose(parameters->start, pose);
  }
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
DemoParameters loadDemoParameters(const ros::NodeHandle& private_node) {
  DemoParameters parameters;
  ParameterReader reader(private_node);
  visitDemoParameters(parameters, reader.visitor(private_node.getNamespace() + "/"));
  reader.know("start");
  reader.knowGroup("scenario");
  reader.warnOfUnknown();
  for (std::string* path : {&parameters.picture, &parameters.result}) *path = resolvedPath(*path);

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

}  // namespace
}  // namespace lstm_planner

int main(int argc, char** argv) {
  using namespace lstm_planner;
  return runNode(argc, argv, "demo_runner",
                 [](const ros::NodeHandle& node) { return DemoRunner(loadDemoParameters(node)).run(); });
}
