#include <ros/ros.h>

#include <csignal>
#include <exception>

#include "lstm_planner/ros/recorder/dataset_recorder.hpp"

namespace {

volatile std::sig_atomic_t stop = 0;

void requestStop(int /*signal*/) { stop = 1; }

}  // namespace

int main(int argc, char** argv) {
  // ROS would be shut down by its own handler before what was heard is written and said.
  ros::init(argc, argv, "dataset_recorder", ros::init_options::NoSigintHandler);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, requestStop);
  ros::NodeHandle private_node("~");  // out here, since nothing is logged any more when the last one has gone
  try {
    return lstm_planner::DatasetRecorder(lstm_planner::loadRecorderNodeParameters(private_node)).run(stop);
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
}
