#pragma once

#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>

#include <csignal>
#include <exception>

#include "ros/common/clock_watch.hpp"

namespace lstm_planner {

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
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, [](int) { stop = 1; });
  const auto run_until_stopped = [&run](const ros::NodeHandle& node) {
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
