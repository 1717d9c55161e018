#include <ros/ros.h>

#include <stdexcept>

#include "lstm_planner/ros/demo/demo_runner.hpp"

int main(int argc, char** argv) {
  ros::init(argc, argv, "demo_runner");
  ros::NodeHandle private_node("~");
  try {
    return lstm_planner::DemoRunner(lstm_planner::loadDemoParameters(private_node)).run();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
}
