#include "ros/common/costmap_footprint.hpp"

#include <ros/console.h>
#include <ros/node_handle.h>

#include <cmath>
#include <sstream>
#include <vector>

namespace lstm_planner {

namespace {

constexpr double kRound = 0.05;  // costmap_2d has 16 corners in place of a circle, whose sides are 2 % nearer

/// Somewhere where costmap_2d looks for it; its default is no robot's.
bool isFootprintSet(const std::string& costmap) {
  const ros::NodeHandle node_handle("~/" + costmap);
  std::string found;
  return node_handle.searchParam("footprint", found) || node_handle.searchParam("robot_radius", found);
}

std::string nameOf(const Footprint& footprint) {
  if (!footprint.isCircle()) return textOf(footprint);
  std::ostringstream text;
  text << "a circle of " << footprint.circumscribedRadius() << " m";
  return text.str();
}

}  // namespace

Footprint safeFootprint(const costmap_2d::Costmap2DROS& costmap, const Footprint& own, const std::string& parameter) {
  if (!isFootprintSet(costmap.getName())) return own;
  std::vector<Point2> corners;
  for (const geometry_msgs::Point& corner : costmap.getUnpaddedRobotFootprint()) {
    corners.push_back({corner.x, corner.y});
  }
  const double beyond = reachBeyond(own, corners);
  if (!std::isfinite(beyond) || beyond == 0.0) return own;
  const Footprint found(corners);
  const bool is_round = found.circumscribedRadius() - found.inscribedRadius() <= kRound * found.circumscribedRadius();
  const Footprint safe = is_round ? Footprint(found.circumscribedRadius()) : found;
  ROS_WARN("%s is %s, the footprint of the costmap %s reaches %.3f m beyond that: %s counts", parameter.c_str(),
           nameOf(own).c_str(), costmap.getName().c_str(), beyond, nameOf(safe).c_str());
  return safe;
}

}  // namespace lstm_planner
