#include <ros/ros.h>
#include <tf2_ros/transform_listener.h>

#include <exception>
#include <lstm_planner/ros/standalone_move_base.hpp>

int main(int argc, char** argv) {
  ros::init(argc, argv, "move_base");
  try {
    tf2_ros::Buffer transforms;
    tf2_ros::TransformListener listener(transforms);
    lstm_planner::StandaloneMoveBase move_base(transforms);
    ros::spin();
  } catch (const std::exception& exception) {
    ROS_FATAL("standalone_move_base: %s", exception.what());
    return 1;
  }
  return 0;
}
