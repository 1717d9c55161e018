#include "ros/recorder/bag_topics.hpp"

#include <actionlib_msgs/GoalID.h>
#include <geometry_msgs/PoseStamped.h>
#include <move_base_msgs/MoveBaseActionGoal.h>
#include <move_base_msgs/MoveBaseActionResult.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "lstm_planner/common/words.hpp"

namespace lstm_planner {

namespace {

using Connections = std::vector<const rosbag::ConnectionInfo*>;

/// Types are told by their definition: tf/tfMessage has that of tf2_msgs/TFMessage.
template <typename Message>
bool isOf(const rosbag::ConnectionInfo& connection) {
  return connection.md5sum == ros::message_traits::MD5Sum<Message>::value();
}

template <typename Message>
std::vector<std::string> topicsOf(const Connections& connections) {
  std::set<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : connections) {
    if (isOf<Message>(*connection)) topics.insert(connection->topic);
  }
  return {topics.begin(), topics.end()};
}

/// What the bag calls a topic; empty if it has none of that name.
std::string nameInBag(const std::string& name, const std::vector<std::string>& topics) {
  const auto topic = std::find_if(topics.begin(), topics.end(), [&](const std::string& candidate) {
    return absoluteTopic(candidate) == absoluteTopic(name);
  });
  return topic == topics.end() ? "" : *topic;
}

/// As nameInBag(); the nearest of those from the namespace of the scans outwards, as in the bag of a robot whose names
/// all begin with its own.
std::string nearestInBag(const std::string& name, const std::string& scan, const std::vector<std::string>& topics) {
  std::string space = absoluteTopic(scan);
  std::string found;
  while (found.empty() && !space.empty()) {
    space.resize(space.rfind('/'));
    found = nameInBag(space + "/" + name, topics);
  }
  return found;
}

std::string contentOf(const Connections& connections) {
  std::set<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : connections) {
    topics.insert(connection->topic + " (" + connection->datatype + ")");
  }
  return topics.empty() ? "none" : joined({topics.begin(), topics.end()});
}

/// The topic that was asked for, or the only one of its type; empty when there is none.
template <typename Message>
std::string choose(const Connections& connections, const std::string& asked_for, const std::string& option) {
  const std::string type = ros::message_traits::DataType<Message>::value();
  const std::vector<std::string> topics = topicsOf<Message>(connections);
  const std::string topic = nameInBag(asked_for, topics);
  if (!asked_for.empty() && topic.empty()) {
    throw std::invalid_argument("has no topic " + absoluteTopic(asked_for) + " of " + type + ", but " +
                                contentOf(connections));
  }
  if (topic.empty() && topics.size() > 1) {
    throw std::invalid_argument("has several topics of " + type + ", expected one of " + joined(topics) + " for " +
                                option);
  }
  return !topic.empty() || topics.empty() ? topic : topics[0];
}

std::vector<std::string> chooseGoals(const Connections& connections, const std::string& scan,
                                     const std::vector<std::string>& asked_for) {
  std::vector<std::string> topics = topicsOf<geometry_msgs::PoseStamped>(connections);
  const std::vector<std::string> actions = topicsOf<move_base_msgs::MoveBaseActionGoal>(connections);
  topics.insert(topics.end(), actions.begin(), actions.end());
  std::vector<std::string> goals;
  if (asked_for.empty()) {
    for (const char* name : {"move_base/goal", "move_base_simple/goal", "dataset_recorder/goal"}) {
      const std::string topic = nearestInBag(name, scan, topics);
      if (!topic.empty()) goals.push_back(topic);
    }
  }
  for (const std::string& name : asked_for) {
    const std::string topic = nameInBag(name, topics);
    if (topic.empty()) {
      throw std::invalid_argument("has no topic " + absoluteTopic(name) +
                                  " of geometry_msgs/PoseStamped or move_base_msgs/MoveBaseActionGoal, but " +
                                  contentOf(connections));
    }
    goals.push_back(topic);
  }
  return goals;
}

/// move_base's own, and those of the action servers that the goals are for.
std::vector<std::string> chooseEnds(const Connections& connections, const std::string& scan,
                                    const std::vector<std::string>& goals) {
  const std::vector<std::string> cancels = topicsOf<actionlib_msgs::GoalID>(connections);
  const std::vector<std::string> results = topicsOf<move_base_msgs::MoveBaseActionResult>(connections);
  std::set<std::string> ends = {nearestInBag("move_base/cancel", scan, cancels),
                                nearestInBag("move_base/result", scan, results)};
  for (const std::string& goal : goals) {
    const std::string topic = absoluteTopic(goal);
    const std::string server = topic.substr(0, topic.rfind('/'));
    ends.insert({nameInBag(server + "/cancel", cancels), nameInBag(server + "/result", results)});
  }
  ends.erase("");
  return {ends.begin(), ends.end()};
}

}  // namespace

std::string absoluteTopic(const std::string& name) { return name.empty() || name[0] == '/' ? name : "/" + name; }

std::vector<std::string> BagTopics::all() const {
  std::vector<std::string> topics = {scan};
  for (const auto* more : {&odometry, &transforms, &static_transforms}) {
    if (!more->empty()) topics.push_back(*more);
  }
  for (const auto* more : {&goals, &ends}) topics.insert(topics.end(), more->begin(), more->end());
  return topics;
}

BagTopics chooseTopics(rosbag::View* view, const BagDriveOptions& options) {
  const Connections connections = view->getConnections();
  BagTopics topics;
  topics.scan = choose<sensor_msgs::LaserScan>(connections, options.scan_topic, "--scan-topic");
  if (topics.scan.empty()) {
    throw std::invalid_argument("has no scans: expected a topic of sensor_msgs/LaserScan among " +
                                contentOf(connections));
  }
  topics.odometry = choose<nav_msgs::Odometry>(connections, options.odometry_topic, "--odometry-topic");
  const std::vector<std::string> transforms = topicsOf<tf2_msgs::TFMessage>(connections);
  topics.transforms = nearestInBag("tf", topics.scan, transforms);
  topics.static_transforms = nearestInBag("tf_static", topics.scan, transforms);
  if (topics.odometry.empty() && topics.transforms.empty() && topics.static_transforms.empty()) {
    throw std::invalid_argument("has no odometry: expected a topic of nav_msgs/Odometry, or /tf, among " +
                                contentOf(connections));
  }
  if (options.hindsight) return topics;
  topics.goals = chooseGoals(connections, topics.scan, options.goal_topics);
  topics.ends = chooseEnds(connections, topics.scan, topics.goals);
  return topics;
}

}  // namespace lstm_planner
