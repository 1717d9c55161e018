#include "lstm_planner/ros/demo/demo_runner.hpp"

#include <cmath>
#include <iostream>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "lstm_planner/grid/map_server_map.hpp"
#include "lstm_planner/ros/common/conversions.hpp"
#include "lstm_planner/ros/common/plugin_parameters.hpp"
#include "ros/common/node_main.hpp"

namespace lstm_planner {
namespace {

constexpr double kPoll = 0.02;          // s of the computer's clock
constexpr double kCancelTime = 5.0;     // s for the action to end after a cancel
constexpr double kTraceSpacing = 0.02;  // m between the points that are kept for the picture
constexpr double kNearestFree = 0.3;    // m around a blocked cell in which the shortest path may start
constexpr double kGridError = 1e-3;     // m, keeps rounding from closing a gap that just fits

void say(const std::string& line) { std::cout << line << std::endl; }

}  // namespace

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
  last_heard_ = ros::WallTime::now();
  if (!spinUntil(parameters_.patience, [this] { return !stamp_.isZero(); })) {
    throw std::runtime_error("nothing on the topic " + truth_subscriber_.getTopic() + ": is the simulation running?");
  }
  if (!spinUntil(parameters_.patience, [this] { return client_.isServerConnected(); })) {
    throw std::runtime_error("no server of the action " + node_.resolveName(parameters_.action) +
                             ": is move_base running?");
  }
}

bool DemoRunner::spinUntil(double seconds, const std::function<bool()>& condition) {
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(seconds);
  while (ros::ok()) {
    ros::spinOnce();
    if (condition()) return true;
    if (ros::WallTime::now() > deadline) return false;
    ros::WallDuration(kPoll).sleep();
  }
  throw std::runtime_error("stopped from outside");
}

void DemoRunner::checkAlive() const {
  if (ros::WallTime::now() - last_heard_ > ros::WallDuration(parameters_.patience)) {
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
  move_base_msgs::MoveBaseGoal message;
  message.target_pose.header.frame_id = parameters_.odom_frame;
  message.target_pose.header.stamp = stamp_;
  message.target_pose.pose = toMessage({position.x, position.y, normalizeAngle(goal.yaw - parameters_.start.yaw)});
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
  last_heard_ = ros::WallTime::now();
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

}  // namespace lstm_planner

int main(int argc, char** argv) {
  using namespace lstm_planner;
  return runNode(argc, argv, "demo_runner",
                 [](const ros::NodeHandle& node) { return DemoRunner(loadDemoParameters(node)).run(); });
}
