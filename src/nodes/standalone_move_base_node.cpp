#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <ros/spinner.h>
#include <tf2_ros/transform_listener.h>

#include <exception>
#include <lstm_planner/ros/standalone_move_base.hpp>

int main(int argc, char** argv) {
  ros::init(argc, argv, "move_base");
  try {
    // The listener's own thread would wake up a hundred times a second whether there are transforms or not.
    ros::NodeHandle transforms_node;
    ros::CallbackQueue transforms_queue;
    transforms_node.setCallbackQueue(&transforms_queue);
    ros::AsyncSpinner transforms_spinner(1, &transforms_queue);
    tf2_ros::Buffer transforms;
    transforms.setUsingDedicatedThread(true);
    tf2_ros::TransformListener listener(transforms, transforms_node, false);
    transforms_spinner.start();
    lstm_planner::StandaloneMoveBase move_base(transforms);
    ros::spin();
  } catch (const std::exception& exception) {
    ROS_FATAL("standalone_move_base: %s", exception.what());
    return 1;
  }
  return 0;
}
