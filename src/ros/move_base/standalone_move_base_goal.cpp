#include "ros/move_base/standalone_move_base_goal.hpp"

#include <tf2/LinearMath/Matrix3x3.h>
#include <tf2/LinearMath/Quaternion.h>
#include <tf2/exceptions.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include <cmath>
#include <stdexcept>

namespace lstm_planner {
namespace {

constexpr double kTransformTimeout = 0.5;     // s
constexpr double kSmallestQuaternion = 1e-6;  // squared length
constexpr double kLargestTilt = 1e-3;         // 1 - cos of the angle to the vertical

geometry_msgs::Quaternion uprightRotation(const geometry_msgs::Quaternion& message) {
  tf2::Quaternion rotation(message.x, message.y, message.z, message.w);
  const double squared_length = rotation.length2();
  if (!std::isfinite(squared_length) || squared_length < kSmallestQuaternion) {
    throw std::invalid_argument("the goal's orientation is a zero quaternion, or not finite");
  }
  rotation.normalize();
  if (std::abs(1.0 - tf2::Matrix3x3(rotation)[2][2]) > kLargestTilt) {
    throw std::invalid_argument("the goal's orientation is tilted; a rotation about the vertical is expected");
  }
  return tf2::toMsg(rotation);
}

}  // namespace

geometry_msgs::PoseStamped goalInFrame(const geometry_msgs::PoseStamped& goal, const std::string& frame,
                                       const tf2_ros::Buffer& tf) {
  geometry_msgs::PoseStamped upright = goal;
  std::string& goal_frame = upright.header.frame_id;
  if (!goal_frame.empty() && goal_frame.front() == '/') goal_frame.erase(0, 1);
  if (goal_frame.empty()) throw std::invalid_argument("the goal has no frame_id");
  const auto& position = goal.pose.position;
  if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) {
    throw std::invalid_argument("the goal's position is not finite");
  }
  upright.pose.orientation = uprightRotation(goal.pose.orientation);
  if (goal_frame == frame) return upright;
  // The newest transform: a goal clicked a while ago still means the place it names now.
  upright.header.stamp = ros::Time(0);
  try {
    return tf.transform(upright, frame, ros::Duration(kTransformTimeout));
  } catch (const tf2::TransformException& exception) {
    throw std::invalid_argument("the goal's frame '" + goal_frame + "' is not connected to '" + frame + "' by tf (" +
                                exception.what() + ")");
  }
}

}  // namespace lstm_planner
