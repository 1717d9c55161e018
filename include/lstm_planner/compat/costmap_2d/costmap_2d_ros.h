#pragma once

#include <costmap_2d/costmap_2d.h>
#include <geometry_msgs/Point.h>
#include <geometry_msgs/PoseStamped.h>
#include <tf2_ros/buffer.h>

#include <string>
#include <vector>

namespace costmap_2d {

/// The part of costmap_2d::Costmap2DROS that says where the robot is, for distributions that do not have costmap_2d.
/// Its costmap is empty and stays so: the plugins of this package see the world through the scan alone.
///
/// Parameters, in "~/" + name:
///  - `global_frame` (string, default "odom"): the frame plans are made in.
///  - `robot_base_frame` (string, default "base_footprint"): the robot's frame.
///  - `transform_tolerance` (double, default 0.3 s): age at which the transform between the two is refused.
class Costmap2DROS {
 public:
  /// Reads the parameters; `tf` must outlive the object.
  Costmap2DROS(const std::string& name, tf2_ros::Buffer& tf);

  const std::string& getName() const noexcept { return name_; }
  const std::string& getGlobalFrameID() const noexcept { return global_frame_; }
  const std::string& getBaseFrameID() const noexcept { return robot_base_frame_; }

  Costmap2D* getCostmap() { return &costmap_; }
  /// Corners in the robot's frame, none unless somebody sets them: the plugins read the parameters `footprint` and
  /// `robot_radius` themselves. There is no padding.
  const std::vector<geometry_msgs::Point>& getRobotFootprint() const noexcept { return footprint_; }
  const std::vector<geometry_msgs::Point>& getUnpaddedRobotFootprint() const noexcept { return footprint_; }
  void setUnpaddedRobotFootprint(const std::vector<geometry_msgs::Point>& points) { footprint_ = points; }

  /// The newest known pose of the robot in the global frame, stamped with the transform's time. False, with a
  /// (throttled) warning that says why, when the transform is missing or older than the tolerance.
  bool getRobotPose(geometry_msgs::PoseStamped& global_pose) const;

 private:
  std::string name_;
  tf2_ros::Buffer& tf_;
  std::string global_frame_;
  std::string robot_base_frame_;
  double transform_tolerance_;
  Costmap2D costmap_;
  std::vector<geometry_msgs::Point> footprint_;
};

}  // namespace costmap_2d
