#pragma once

#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>

#include <algorithm>
#include <csignal>
#include <exception>

namespace lstm_planner {

/// Says so when there is no time: with /use_sim_time, which outlives the simulation in a roscore, but without /clock or
/// with one of a simulator that is paused, a node waits for ever. Needs somebody who spins.
class ClockWatch {
 public:
  ClockWatch() : timer_(ros::NodeHandle().createWallTimer(ros::WallDuration(kPeriod), &ClockWatch::look, this)) {}

 private:
  static constexpr double kPeriod = 5.0;  // s
  static constexpr int kPatience = 2;     // looks: who has advertised it may wait for listeners, as bag_replay does

  void look(const ros::WallTimerEvent& /*event*/) {
    // Without a master, the list of topics would be waited for, also by a node that is told to stop.
    if (!ros::Time::now().isZero() || !ros::master::check()) return;
    if (!isPublished(ros::names::resolve("/clock"))) {
      ROS_WARN("there is no time: /use_sim_time is true, but nobody publishes /clock. rosparam delete /use_sim_time");
    } else if (++looks_ >= kPatience) {
      ROS_WARN(
          "there is no time: /use_sim_time is true, but nothing comes on /clock. Is the simulator or rosbag paused?");
    }
  }

  static bool isPublished(const std::string& name) {
    ros::master::V_TopicInfo topics;
    ros::master::getTopics(topics);
    return std::any_of(topics.begin(), topics.end(),
                       [&](const ros::master::TopicInfo& topic) { return topic.name == name; });
  }

  int looks_ = 0;  ///< that found somebody who has advertised the clock
  ros::WallTimer timer_;
};

/// What a node's main() is: calls run(private node handle) and returns its exit status. 1 where an exception ends it,
/// which the log then has.
template <typename Run>
int runNode(int argc, char** argv, const char* name, const Run& run, unsigned options = 0) {
  ros::init(argc, argv, name, options);
  ros::NodeHandle private_node("~");  // out here, since nothing is logged any more when the last one has gone
  const ClockWatch clock_watch;
  try {
    return run(private_node);
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
}

/// The same for a node that has something to finish, which ROS's own handler of signals would leave no time for: calls
/// run(private node handle, stop). SIGINT, SIGTERM, SIGHUP and `rosnode kill` set `stop`.
template <typename Run>
int runUntilStopped(int argc, char** argv, const char* name, const Run& run) {
  static volatile std::sig_atomic_t stop = 0;
  const auto run_until_stopped = [&run](const ros::NodeHandle& node) {
    // Not before: as long as ROS waits for a master there is nothing to finish, and nobody looks at `stop`.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, [](int) { stop = 1; });
    const auto stop_by_call = [](XmlRpc::XmlRpcValue& call, XmlRpc::XmlRpcValue& answer) {
      const bool has_reason = call.getType() == XmlRpc::XmlRpcValue::TypeArray && call.size() > 1;
      if (has_reason) ROS_WARN_STREAM("stopped from outside: " << call[1]);
      stop = 1;
      answer = ros::xmlrpc::responseInt(1, "", 0);
    };
    ros::XMLRPCManager::instance()->unbind("shutdown");
    ros::XMLRPCManager::instance()->bind("shutdown", stop_by_call);
    return run(node, stop);
  };
  return runNode(argc, argv, name, run_until_stopped, ros::init_options::NoSigintHandler);
}

}  // namespace lstm_planner
