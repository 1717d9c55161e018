#include "lstm_planner/ros/common/costmap_footprint.hpp"

#include <ros/console.h>
#include <ros/node_handle.h>

#include <algorithm>
#include <cmath>

namespace lstm_planner {

namespace {

constexpr double kSame = 0.002;  // m

/// Somewhere where costmap_2d looks for it; its default is no robot's.
bool isFootprintSet(const std::string& costmap) {
  const ros::NodeHandle node_handle("~/" + costmap);
  std::string found;
  return node_handle.searchParam("footprint", found) || node_handle.searchParam("robot_radius", found);
}

}  // namespace

double safeFootprintRadius(const costmap_2d::Costmap2DROS& costmap, double radius, const std::string& parameter) {
  if (!isFootprintSet(costmap.getName())) return radius;
  double farthest = 0.0;
  for (const geometry_msgs::Point& corner : costmap.getUnpaddedRobotFootprint()) {
    farthest = std::max(farthest, std::hypot(corner.x, corner.y));
  }
  if (!std::isfinite(farthest) || farthest <= radius + kSame) return radius;
  ROS_WARN(
      "the footprint of the costmap %s reaches %.3f m from the robot's middle, %s is %.3f m: the larger one counts",
      costmap.getName().c_str(), farthest, parameter.c_str(), radius);
  return farthest;
}

}  // namespace lstm_planner
