#pragma once

#include <ros/ros.h>

#include <algorithm>
#include <string>

namespace lstm_planner {

/// Says so when there is no time: with /use_sim_time, which outlives the simulation in a roscore, but without /clock a
/// node waits for ever. Needs somebody who spins.
class ClockWatch {
 public:
  ClockWatch() : timer_(ros::NodeHandle().createWallTimer(ros::WallDuration(kPeriod), &ClockWatch::look)) {}

 private:
  static constexpr double kPeriod = 5.0;  // s

  static void look(const ros::WallTimerEvent& /*event*/) {
    if (!ros::Time::now().isZero() || isPublished(ros::names::resolve("/clock"))) return;
    ROS_WARN("there is no time: /use_sim_time is true, but nobody publishes /clock. rosparam delete /use_sim_time");
  }

  /// Who has advertised it may wait for listeners, as bag_replay does.
  static bool isPublished(const std::string& name) {
    ros::master::V_TopicInfo topics;
    ros::master::getTopics(topics);
    return std::any_of(topics.begin(), topics.end(),
                       [&](const ros::master::TopicInfo& topic) { return topic.name == name; });
  }

  ros::WallTimer timer_;
};

}  // namespace lstm_planner
