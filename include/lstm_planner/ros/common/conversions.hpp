#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Header.h>

#include <string>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"

namespace lstm_planner {

/// Overwrites `scan`, reusing its memory.
void fromMessage(const sensor_msgs::LaserScan& message, LaserScan* scan);

/// Overwrites all but the header, the times of a beam and a scan, and the intensities.
void toMessage(const LaserScan& scan, sensor_msgs::LaserScan* message);

/// Position and yaw; the yaw is NaN when the quaternion is zero or not finite.
Pose2 fromMessage(const geometry_msgs::Pose& message);

/// Of a message whose sender did not set it: no rotation at all.
bool isZero(const geometry_msgs::Quaternion& q);

/// Planar part of a transform.
Pose2 fromMessage(const geometry_msgs::Transform& message);

/// With a unit quaternion.
geometry_msgs::Pose toMessage(const Pose2& pose);

/// In a frame, as a goal is.
geometry_msgs::PoseStamped toMessage(const Pose2& pose, const std::string& frame, const ros::Time& stamp = {});

/// Where the frame `child` lies in the frame `parent`.
geometry_msgs::TransformStamped toMessage(const Pose2& pose, const std::string& parent, const std::string& child,
                                          const ros::Time& stamp = {});

/// Where a scanner sits in the base frame.
geometry_msgs::TransformStamped mountToMessage(const SensorMount& mount, const std::string& base_frame,
                                               const std::string& scanner_frame, const ros::Time& stamp = {});

/// How a scanner sits, from the transform of its frame to the base frame. Throws std::invalid_argument when it is
/// tilted by more than 15 degrees: such a scan does not show the floor plan.
SensorMount mountFromMessage(const geometry_msgs::Transform& base_from_scanner);

/// Many poses, as in a plan, all with that header; quick where neighbours have the same yaw. Overwrites `messages`,
/// reusing its memory.
void toMessages(const std::vector<Pose2>& poses, const std_msgs::Header& header,
                std::vector<geometry_msgs::PoseStamped>* messages);

/// When a message was made: when it was received stands in where a driver leaves its stamp zero.
ros::Time stampOr(const ros::Time& stamp, const ros::Time& received);

/// Frame without the leading slash that old drivers put there and tf2 refuses.
std::string frameName(const std::string& frame_id);

/// The robot's frame, as odometry names it: child_frame_id. Empty where that is empty or the odometry's own frame.
std::string robotFrameOf(const nav_msgs::Odometry& odometry);

}  // namespace lstm_planner
