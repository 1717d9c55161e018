#include "lstm_planner/ros/planner/marker_shapes.hpp"

namespace lstm_planner {

using visualization_msgs::Marker;

std_msgs::ColorRGBA makeColor(double red, double green, double blue, double alpha) {
  std_msgs::ColorRGBA result;
  result.r = static_cast<float>(red);
  result.g = static_cast<float>(green);
  result.b = static_cast<float>(blue);
  result.a = static_cast<float>(alpha);
  return result;
}

geometry_msgs::Point makePoint(const Point2& position, double height) {
  geometry_msgs::Point result;
  result.x = position.x;
  result.y = position.y;
  result.z = height;
  return result;
}

Marker makeMarker(const std_msgs::Header& header, const std::string& name_space, int id, int type,
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

Marker makeSectorMarker(const std_msgs::Header& header, const Pose2& pose, const Sectors& sectors, double angle_span) {
  constexpr int kPiecesOfAnArc = 8;
  Marker arcs = makeMarker(header, "sectors", 0, Marker::LINE_LIST, makeColor(0.6, 0.1, 0.8));
  arcs.scale.x = 0.05;
  const double width = angle_span / kSectorCount;
  for (int sector = 0; sector < kSectorCount; ++sector) {
    const double start = pose.yaw - 0.5 * angle_span + sector * width;
    const double range = sectors.range[static_cast<std::size_t>(sector)];
    const auto shade = sectors.hasMeasurement(sector) ? arcs.color : makeColor(0.6, 0.1, 0.8, 0.35);
    for (int piece = 0; piece < kPiecesOfAnArc; ++piece) {
      for (const int end : {piece, piece + 1}) {
        const double direction = start + width * (0.04 + 0.92 * end / kPiecesOfAnArc);
        arcs.points.push_back(makePoint(pointAlong(pose, direction, range), kSectorHeight));
        arcs.colors.push_back(shade);
      }
    }
  }
  return arcs;
}

void addArrow(const Pose2& pose, double angle, double length, double height, const std_msgs::ColorRGBA& color,
              Marker* lines) {
  constexpr double kHead = 0.4;       // of the length
  constexpr double kHeadAngle = 2.7;  // rad from the arrow's direction
  const double direction = pose.yaw + angle;
  const Point2 tip = pointAlong(pose, direction, length);
  const auto addLine = [&](const Point2& start, const Point2& end) {
    for (const Point2& position : {start, end}) {
      lines->points.push_back(makePoint(position, height));
      lines->colors.push_back(color);
    }
  };
  addLine({pose.x, pose.y}, tip);
  addLine(tip, pointAlong(tip, direction + kHeadAngle, kHead * length));
  addLine(tip, pointAlong(tip, direction - kHeadAngle, kHead * length));
}

void addGoalMarkers(const std_msgs::Header& header, const Pose2& goal, visualization_msgs::MarkerArray* markers) {
  Marker disc = makeMarker(header, "goal", 0, Marker::CYLINDER, makeColor(0.0, 0.7, 0.1));
  disc.pose.position = makePoint({goal.x, goal.y}, kSectorHeight);
  disc.scale.x = disc.scale.y = 0.3;
  disc.scale.z = 0.02;
  markers->markers.push_back(disc);
  Marker arrow = makeMarker(header, "goal", 1, Marker::ARROW, disc.color);
  arrow.points = {makePoint({goal.x, goal.y}, kArrowHeight), makePoint(pointAlong(goal, goal.yaw, 0.4), kArrowHeight)};
  arrow.scale.x = 0.04;
  arrow.scale.y = 0.1;
  arrow.scale.z = 0.12;
  markers->markers.push_back(arrow);
}

}  // namespace lstm_planner
