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

std::vector<std::string> chooseGoals(const Connections& connections, const std::vector<std::string>& asked_for) {
  std::vector<std::string> topics = topicsOf<geometry_msgs::PoseStamped>(connections);
  const std::vector<std::string> actions = topicsOf<move_base_msgs::MoveBaseActionGoal>(connections);
  topics.insert(topics.end(), actions.begin(), actions.end());
  std::vector<std::string> goals;
  if (asked_for.empty()) {
    for (const char* name : {"/move_base/goal", "/move_base_simple/goal", "/dataset_recorder/goal"}) {
      const std::string topic = nameInBag(name, topics);
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
std::vector<std::string> chooseEnds(const Connections& connections, const std::vector<std::string>& goals) {
  std::set<std::string> servers = {"/move_base"};
  for (const std::string& goal : goals) {
    const std::string topic = absoluteTopic(goal);
    servers.insert(topic.substr(0, topic.rfind('/')));
  }
  std::vector<std::string> ends;
  for (const std::string& server : servers) {
    for (const rosbag::ConnectionInfo* connection : connections) {
      const std::string topic = absoluteTopic(connection->topic);
      const bool is_cancel = topic == server + "/cancel" && isOf<actionlib_msgs::GoalID>(*connection);
      const bool is_result = topic == server + "/result" && isOf<move_base_msgs::MoveBaseActionResult>(*connection);
      if ((is_cancel || is_result) && !contains(ends, connection->topic)) ends.push_back(connection->topic);
    }
  }
  return ends;
}

}  // namespace

std::string absoluteTopic(const std::string& name) { return name.empty() || name[0] == '/' ? name : "/" + name; }

std::vector<std::string> BagTopics::all() const {
  std::vector<std::string> topics = {scan};
  if (!odometry.empty()) topics.push_back(odometry);
  for (const auto* more : {&transforms, &goals, &ends}) topics.insert(topics.end(), more->begin(), more->end());
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
  for (const char* name : {"/tf", "/tf_static"}) {
    const std::string topic = nameInBag(name, transforms);
    if (!topic.empty()) topics.transforms.push_back(topic);
  }
  if (topics.odometry.empty() && topics.transforms.empty()) {
    throw std::invalid_argument("has no odometry: expected a topic of nav_msgs/Odometry, or /tf, among " +
                                contentOf(connections));
  }
  if (options.hindsight) return topics;
  topics.goals = chooseGoals(connections, options.goal_topics);
  topics.ends = chooseEnds(connections, topics.goals);
  return topics;
}

}  // namespace lstm_planner
