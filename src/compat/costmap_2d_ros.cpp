#include <costmap_2d/costmap_2d_ros.h>
#include <ros/ros.h>
#include <tf2/exceptions.h>

namespace costmap_2d {
namespace {

constexpr double kWarningPeriod = 1.0;  // s

std::string withoutLeadingSlash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

}  // namespace

Costmap2DROS::Costmap2DROS(const std::string& name, tf2_ros::Buffer& tf) : name_(name), tf_(tf) {
  ros::NodeHandle parameters("~/" + name);
  global_frame_ = withoutLeadingSlash(parameters.param<std::string>("global_frame", "odom"));
  robot_base_frame_ = withoutLeadingSlash(parameters.param<std::string>("robot_base_frame", "base_footprint"));
  transform_tolerance_ = parameters.param("transform_tolerance", 0.3);
}

bool Costmap2DROS::getRobotPose(geometry_msgs::PoseStamped& global_pose) const {
  geometry_msgs::TransformStamped transform;
  try {
    transform = tf_.lookupTransform(global_frame_, robot_base_frame_, ros::Time(0));
  } catch (const tf2::TransformException& exception) {
    ROS_WARN_THROTTLE(kWarningPeriod, "%s: the robot's pose is unknown: %s", name_.c_str(), exception.what());
    return false;
  }
  const double age = ros::Time::now().toSec() - transform.header.stamp.toSec();
  // A transform without a stamp is a static one and does not age.
  if (!transform.header.stamp.isZero() && age > transform_tolerance_) {
    ROS_WARN_THROTTLE(kWarningPeriod, "%s: the transform from %s to %s is %.2f s old, older than %.2f s", name_.c_str(),
                      robot_base_frame_.c_str(), global_frame_.c_str(), age, transform_tolerance_);
    return false;
  }
  global_pose.header = transform.header;
  global_pose.pose.position.x = transform.transform.translation.x;
  global_pose.pose.position.y = transform.transform.translation.y;
  global_pose.pose.position.z = transform.transform.translation.z;
  global_pose.pose.orientation = transform.transform.rotation;
  return true;
}

}  // namespace costmap_2d
