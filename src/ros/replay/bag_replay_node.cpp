#include <ros/ros.h>

#include <exception>

#include "lstm_planner/ros/replay/bag_replay.hpp"

int main(int argc, char** argv) {
  ros::init(argc, argv, "bag_replay");
  ros::NodeHandle private_node("~");
  try {
    lstm_planner::BagReplay(lstm_planner::loadBagReplayParameters(private_node)).run();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
