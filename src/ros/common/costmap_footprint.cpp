#include "ros/common/costmap_footprint.hpp"

#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/param.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "ros/common/parameter_value.hpp"

namespace lstm_planner {

namespace {

constexpr double kRound = 0.05;  // the sides of costmap_2d's polygon for a circle are 2 % nearer

/// Where costmap_2d looks for a parameter; empty where nobody has set it.
std::string nameOf(const std::string& costmap, const std::string& parameter) {
  std::string found;
  return ros::NodeHandle("~/" + costmap).searchParam(parameter, found) ? found : "";
}

/// As costmap_2d reads them, for a stand-in that does not. Throws std::invalid_argument naming the parameter.
std::vector<Point2> cornersByParameters(const std::string& polygon, const std::string& radius) {
  XmlRpc::XmlRpcValue value;
  if (!polygon.empty() && ros::param::get(polygon, value)) {
    const std::string text = asText(value).value_or("a structure");
    if (!text.empty() && text != "[]") return footprintOf(polygon, 0.0, text).corners();
  }
  if (radius.empty() || !ros::param::get(radius, value)) return {};
  const std::optional<double> number = asNumber(value);
  if (!number || !(*number > 0.0)) {
    throw std::invalid_argument("parameter " + radius + " is " + asText(value).value_or("a structure") +
                                ", expected a positive number");
  }
  return costmapCircle(*number);
}

std::string describe(const Footprint& footprint) {
  if (!footprint.isCircle()) return textOf(footprint);
  return "a circle of " + numberText(footprint.circumscribedRadius()) + " m";
}

}  // namespace

Footprint safeFootprint(const costmap_2d::Costmap2DROS& costmap, const Footprint& own, const std::string& parameter) {
  const std::string polygon = nameOf(costmap.getName(), "footprint");
  const std::string radius = nameOf(costmap.getName(), "robot_radius");
  if (polygon.empty() && radius.empty()) return own;  // costmap_2d's default is no robot's
  std::vector<Point2> corners;
  for (const geometry_msgs::Point& corner : costmap.getUnpaddedRobotFootprint()) {
    corners.push_back({corner.x, corner.y});
  }
  if (corners.empty()) corners = cornersByParameters(polygon, radius);
  const double beyond = reachBeyond(own, corners);
  if (!std::isfinite(beyond) || beyond == 0.0) return own;
  const Footprint found(corners);
  const bool is_round = found.circumscribedRadius() - found.inscribedRadius() <= kRound * found.circumscribedRadius();
  const Footprint safe = is_round ? Footprint(found.circumscribedRadius()) : found;
  ROS_WARN("%s is %s, the footprint of the costmap %s reaches %.3f m beyond that: %s counts", parameter.c_str(),
           describe(own).c_str(), costmap.getName().c_str(), beyond, describe(safe).c_str());
  return safe;
}

}  // namespace lstm_planner
