#include <ros/ros.h>

#include <csignal>
#include <exception>

#include "lstm_planner/ros/advice/drive_advice.hpp"

namespace {

volatile std::sig_atomic_t stop = 0;

void requestStop(int /*signal*/) { stop = 1; }

}  // namespace

int main(int argc, char** argv) {
  // ROS would be shut down by its own handler before what was agreed on is said.
  ros::init(argc, argv, "drive_advice", ros::init_options::NoSigintHandler);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, requestStop);
  ros::NodeHandle private_node("~");  // out here, since nothing is logged any more when the last one has gone
  try {
    return lstm_planner::DriveAdvice(lstm_planner::loadDriveAdviceParameters(private_node)).run(stop);
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
}
