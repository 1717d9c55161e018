#include <ros/ros.h>

#include <stdexcept>

#include "lstm_planner/ros/create2_stub/create2_stub.hpp"

int main(int argc, char** argv) {
  ros::init(argc, argv, "create2_stub");
  ros::NodeHandle private_node("~");
  try {
    lstm_planner::Create2Stub(lstm_planner::loadCreate2StubParameters(private_node)).run();
  } catch (const std::invalid_argument& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
