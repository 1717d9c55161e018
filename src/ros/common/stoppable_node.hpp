#pragma once

#include <ros/ros.h>

#include <csignal>
#include <exception>

namespace lstm_planner {

/// What a node's main() is that has something to finish, which ROS's own handler of signals would leave no time for:
/// calls run(private node handle, stop) and returns its exit status. SIGINT, SIGTERM and SIGHUP set `stop`. 1 where an
/// exception ends it, which the log then has.
template <typename Run>
int runUntilStopped(int argc, char** argv, const char* name, const Run& run) {
  static volatile std::sig_atomic_t stop = 0;
  ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, [](int) { stop = 1; });
  ros::NodeHandle private_node("~");  // out here, since nothing is logged any more when the last one has gone
  try {
    return run(private_node, stop);
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
}

}  // namespace lstm_planner
