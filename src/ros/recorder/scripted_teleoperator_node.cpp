#include <ros/ros.h>

#include <atomic>
#include <csignal>
#include <stdexcept>

#include "lstm_planner/ros/recorder/scripted_teleoperator.hpp"

namespace {

std::atomic<bool> stop_wanted{false};

void onSignal(int) { stop_wanted = true; }

}  // namespace

int main(int argc, char** argv) {
  // ROS's own handler ends all communication before the robot could be told to stop.
  ros::init(argc, argv, "scripted_teleoperator", ros::init_options::NoSigintHandler);
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
  ros::NodeHandle private_node("~");
  try {
    return lstm_planner::ScriptedTeleoperator(lstm_planner::loadTeleoperatorParameters(private_node)).run(stop_wanted);
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
}
