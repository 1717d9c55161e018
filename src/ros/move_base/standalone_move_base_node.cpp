#include <ros/ros.h>
#include <tf2_ros/buffer.h>

#include <exception>

#include "lstm_planner/ros/common/transform_listener.hpp"
#include "ros/move_base/standalone_move_base.hpp"

int main(int argc, char** argv) {
  ros::init(argc, argv, "move_base");
  const ros::NodeHandle node_handle;  // out here, since nothing is logged any more when the last one has gone
  try {
    tf2_ros::Buffer transforms;
    const lstm_planner::TransformListener listener(&transforms);
    lstm_planner::StandaloneMoveBase move_base(transforms);
    ros::spin();
  } catch (const std::exception& exception) {
    ROS_FATAL("standalone_move_base: %s", exception.what());
    return 1;
  }
  return 0;
}
