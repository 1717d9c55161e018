#include "lstm_planner/ros/common/conversions.hpp"

#include <tf2/LinearMath/Quaternion.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/drive/perception/observation.hpp"

namespace lstm_planner {

namespace {

double yawOf(const geometry_msgs::Quaternion& q) { return yawOfQuaternion(q.x, q.y, q.z, q.w); }

}  // namespace

void fromMessage(const sensor_msgs::LaserScan& message, LaserScan* scan) {
  scan->stamp = message.header.stamp.toSec();
  scan->angle_min = message.angle_min;
  scan->angle_increment = message.angle_increment;
  scan->range_min = message.range_min;
  scan->range_max = message.range_max;
  scan->ranges.assign(message.ranges.begin(), message.ranges.end());
}

void toMessage(const LaserScan& scan, sensor_msgs::LaserScan* message) {
  message->angle_min = static_cast<float>(scan.angle_min);
  message->angle_max =
      static_cast<float>(scan.angle_min + scan.angle_increment * (static_cast<double>(scan.ranges.size()) - 1.0));
  message->angle_increment = static_cast<float>(scan.angle_increment);
  message->range_min = static_cast<float>(scan.range_min);
  message->range_max = static_cast<float>(scan.range_max);
  message->ranges = scan.ranges;
}

Pose2 fromMessage(const geometry_msgs::Pose& message) {
  return {message.position.x, message.position.y, yawOf(message.orientation)};
}

bool isZero(const geometry_msgs::Quaternion& q) { return q.x == 0.0 && q.y == 0.0 && q.z == 0.0 && q.w == 0.0; }

Pose2 fromMessage(const geometry_msgs::Transform& message) {
  return {message.translation.x, message.translation.y, yawOf(message.rotation)};
}

geometry_msgs::Pose toMessage(const Pose2& pose) {
  geometry_msgs::Pose message;
  message.position.x = pose.x;
  message.position.y = pose.y;
  message.orientation.z = std::sin(0.5 * pose.yaw);
  message.orientation.w = std::cos(0.5 * pose.yaw);
  return message;
}

geometry_msgs::PoseStamped toMessage(const Pose2& pose, const std::string& frame, const ros::Time& stamp) {
  geometry_msgs::PoseStamped message;
  message.header.frame_id = frame;
  message.header.stamp = stamp;
  message.pose = toMessage(pose);
  return message;
}

geometry_msgs::TransformStamped toMessage(const Pose2& pose, const std::string& parent, const std::string& child,
                                          const ros::Time& stamp) {
  geometry_msgs::TransformStamped message;
  message.header.frame_id = parent;
  message.header.stamp = stamp;
  message.child_frame_id = child;
  message.transform.translation.x = pose.x;
  message.transform.translation.y = pose.y;
  message.transform.rotation = toMessage(pose).orientation;
  return message;
}

geometry_msgs::TransformStamped mountToMessage(const SensorMount& mount, const std::string& base_frame,
                                               const std::string& scanner_frame, const ros::Time& stamp) {
  geometry_msgs::TransformStamped message = toMessage(mount.pose, base_frame, scanner_frame, stamp);
  if (mount.upside_down) {
    tf2::Quaternion rotation;
    rotation.setRPY(M_PI, 0.0, mount.pose.yaw);
    message.transform.rotation.x = rotation.x();
    message.transform.rotation.y = rotation.y();
    message.transform.rotation.z = rotation.z();
    message.transform.rotation.w = rotation.w();
  }
  return message;
}

SensorMount mountFromMessage(const geometry_msgs::Transform& base_from_scanner) {
  constexpr double kLargestTilt = 15.0;
  const geometry_msgs::Quaternion& q = base_from_scanner.rotation;
  const Eigen::Matrix3d rotation = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  const double upwards = rotation(2, 2);
  if (!(std::abs(upwards) >= std::cos(degreesToRadians(kLargestTilt)))) {
    throw std::invalid_argument("the scanner is tilted by " +
                                fixedText(std::acos(std::abs(upwards)) * 180.0 / M_PI, 1) +
                                " degrees, expected at most 15");
  }
  SensorMount mount;
  mount.upside_down = upwards < 0.0;
  mount.pose = {base_from_scanner.translation.x, base_from_scanner.translation.y,
                std::atan2(rotation(1, 0), rotation(0, 0))};
  return mount;
}

void toMessages(const std::vector<Pose2>& poses, const std_msgs::Header& header,
                std::vector<geometry_msgs::PoseStamped>* messages) {
  messages->resize(poses.size());
  double yaw = std::numeric_limits<double>::quiet_NaN();
  geometry_msgs::Pose message;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (poses[i].yaw != yaw) {
      yaw = poses[i].yaw;
      message = toMessage(poses[i]);
    }
    message.position.x = poses[i].x;
    message.position.y = poses[i].y;
    (*messages)[i].header = header;
    (*messages)[i].pose = message;
  }
}

ros::Time stampOr(const ros::Time& stamp, const ros::Time& received) { return stamp.isZero() ? received : stamp; }

std::string frameName(const std::string& frame_id) {
  return !frame_id.empty() && frame_id.front() == '/' ? frame_id.substr(1) : frame_id;
}

std::string robotFrameOf(const nav_msgs::Odometry& odometry) {
  const std::string frame = frameName(odometry.child_frame_id);
  return frame == frameName(odometry.header.frame_id) ? "" : frame;
}

}  // namespace lstm_planner
