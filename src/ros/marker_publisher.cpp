#include "lstm_planner/ros/marker_publisher.hpp"

#include <algorithm>
#include <cmath>

#include "lstm_planner/ros/conversions.hpp"

namespace lstm_planner {

namespace {

using visualization_msgs::Marker;

constexpr double kSectorHeight = 0.02;   // m above the floor; the layers lie one above the other
constexpr double kTraceHeight = 0.03;
constexpr double kArrowHeight = 0.06;
constexpr double kTraceSpacing = 0.05;   // m

std_msgs::ColorRGBA color(double red, double green, double blue, double alpha = 1.0) {
  std_msgs::ColorRGBA result;
  result.r = static_cast<float>(red);
  result.g = static_cast<float>(green);
  result.b = static_cast<float>(blue);
  result.a = static_cast<float>(alpha);
  return result;
}

geometry_msgs::Point point(const Point2& position, double height) {
  geometry_msgs::Point result;
  result.x = position.x;
  result.y = position.y;
  result.z = height;
  return result;
}

Marker marker(const std_msgs::Header& header, const std::string& name_space, int id, int type,
              const std_msgs::ColorRGBA& color) {
  Marker result;
  result.header = header;
  result.ns = name_space;
  result.id = id;
  result.type = type;
  result.action = Marker::ADD;
  result.pose.orientation.w = 1.0;
  result.color = color;
  return result;
}

/// Preferences are the network's last layer, whatever that is: only their order and distances mean something.
double shareOf(const std::vector<float>& preferences, std::size_t i) {
  const auto [least, most] = std::minmax_element(preferences.begin(), preferences.end());
  return *most > *least ? (preferences[i] - *least) / (*most - *least) : 1.0;
}

}  // namespace

MarkerPublisher::MarkerPublisher(ros::NodeHandle node_handle, const PolicyDescription& description, int trace_length)
    : description_(description),
      trace_length_(static_cast<std::size_t>(trace_length)),
      publisher_(node_handle.advertise<visualization_msgs::MarkerArray>("markers", 1)) {}

void MarkerPublisher::publish(const std_msgs::Header& header, const Situation& situation, const Decision& decision,
                              const Pose2& goal) {
  extendTrace(situation.pose);
  if (publisher_.getNumSubscribers() == 0) {
    return;
  }
  markers_.markers.clear();
  addSectors(header, situation);
  addPreferences(header, situation, decision);
  addWaypoint(header, decision);
  addTrace(header);
  addGoal(header, goal);
  publisher_.publish(markers_);
}

void MarkerPublisher::extendTrace(const Pose2& pose) {
  if (trace_.empty() || distanceBetween(trace_.back(), pose) >= kTraceSpacing) {
    trace_.push_back({pose.x, pose.y});
  }
  while (trace_.size() > trace_length_) {
    trace_.pop_front();
  }
}

void MarkerPublisher::addSectors(const std_msgs::Header& header, const Situation& situation) {
  constexpr int kPiecesOfAnArc = 8;
  Marker arcs = marker(header, "sectors", 0, Marker::LINE_LIST, color(0.6, 0.1, 0.8));
  arcs.scale.x = 0.05;
  const double width = description_.encoder.angle_span / kSectorCount;
  for (int sector = 0; sector < kSectorCount; ++sector) {
    const double begin = situation.pose.yaw - 0.5 * description_.encoder.angle_span + sector * width;
    const double range = situation.sectors.range[static_cast<std::size_t>(sector)];
    // A sector where nothing was seen is drawn paler: its range is only the cap.
    const auto shade = situation.sectors.hasMeasurement(sector) ? arcs.color : color(0.6, 0.1, 0.8, 0.35);
    for (int piece = 0; piece < kPiecesOfAnArc; ++piece) {
      for (const int end : {piece, piece + 1}) {
        const double direction = begin + width * (0.04 + 0.92 * end / kPiecesOfAnArc);
        arcs.points.push_back(point(pointAlong(situation.pose, direction, range), kSectorHeight));
        arcs.colors.push_back(shade);
      }
    }
  }
  markers_.markers.push_back(arcs);
}

void MarkerPublisher::addPreferences(const std_msgs::Header& header, const Situation& situation,
                                     const Decision& decision) {
  constexpr double kShortest = 0.25;  // m
  constexpr double kLongest = 0.8;    // m
  for (std::size_t i = 0; i < decision.preferences.size(); ++i) {
    const int action = static_cast<int>(i);
    const bool chosen = action == decision.action;
    const auto shade = !decision.allowed[i] ? color(0.5, 0.5, 0.5)
                                            : (chosen ? color(1.0, 0.55, 0.0) : color(0.1, 0.4, 0.9));
    Marker arrow = marker(header, "preferences", action, Marker::ARROW, shade);
    const double length = kShortest + (kLongest - kShortest) * shareOf(decision.preferences, i);
    const double direction = situation.pose.yaw + description_.actions.angle(action);
    arrow.points = {point({situation.pose.x, situation.pose.y}, kArrowHeight),
                    point(pointAlong(situation.pose, direction, length), kArrowHeight)};
    arrow.scale.x = 0.03;
    arrow.scale.y = 0.08;
    arrow.scale.z = 0.1;
    markers_.markers.push_back(arrow);
  }
}

void MarkerPublisher::addWaypoint(const std_msgs::Header& header, const Decision& decision) {
  Marker sphere = marker(header, "waypoint", 0, Marker::SPHERE, color(1.0, 0.55, 0.0));
  sphere.pose.position = point(decision.waypoint, kArrowHeight);
  sphere.scale.x = sphere.scale.y = sphere.scale.z = 0.14;
  markers_.markers.push_back(sphere);
}

void MarkerPublisher::addTrace(const std_msgs::Header& header) {
  Marker line = marker(header, "trace", 0, Marker::LINE_STRIP, color(0.9, 0.0, 0.0));
  line.scale.x = 0.05;
  for (const Point2& position : trace_) {
    line.points.push_back(point(position, kTraceHeight));
  }
  // rviz reports a line of fewer than two points as an error.
  line.action = line.points.size() < 2 ? static_cast<int>(Marker::DELETE) : static_cast<int>(Marker::ADD);
  markers_.markers.push_back(line);
}

void MarkerPublisher::addGoal(const std_msgs::Header& header, const Pose2& goal) {
  Marker disc = marker(header, "goal", 0, Marker::CYLINDER, color(0.0, 0.7, 0.1));
  disc.pose.position = point({goal.x, goal.y}, kSectorHeight);
  disc.scale.x = disc.scale.y = 0.3;
  disc.scale.z = 0.02;
  markers_.markers.push_back(disc);
  Marker arrow = marker(header, "goal", 1, Marker::ARROW, disc.color);
  arrow.points = {point({goal.x, goal.y}, kArrowHeight), point(pointAlong(goal, goal.yaw, 0.4), kArrowHeight)};
  arrow.scale.x = 0.04;
  arrow.scale.y = 0.1;
  arrow.scale.z = 0.12;
  markers_.markers.push_back(arrow);
}

}  // namespace lstm_planner
