#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

namespace {

template <typename Message>
void ignore(const typename Message::ConstPtr& /*message*/) {}

}  // namespace

/// Receives what the plugins receive, and does nothing with it: what test/bench/node_cost.py subtracts.
int main(int argc, char** argv) {
  ros::init(argc, argv, "message_receiver");
  ros::NodeHandle node_handle;
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  const ros::Subscriber scans = node_handle.subscribe("scan", 1, ignore<sensor_msgs::LaserScan>, hints);
  const ros::Subscriber odometry = node_handle.subscribe("odom", 10, ignore<nav_msgs::Odometry>, hints);
  const ros::Subscriber transforms = node_handle.subscribe("tf", 100, ignore<tf2_msgs::TFMessage>);
  ros::spin();
  return 0;
}
