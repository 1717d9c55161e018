#pragma once

#include <geometry_msgs/Point.h>
#include <std_msgs/ColorRGBA.h>
#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/sectors.hpp"

namespace lstm_planner {

// What the markers of several nodes are made of, so that the same thing looks the same. All in the header's frame.

// m above the floor; the layers lie one above the other
constexpr double kSectorHeight = 0.02;
constexpr double kTraceHeight = 0.03;
constexpr double kArrowHeight = 0.06;

std_msgs::ColorRGBA makeColor(double red, double green, double blue, double alpha = 1.0);
geometry_msgs::Point makePoint(const Point2& position, double height);
visualization_msgs::Marker makeMarker(const std_msgs::Header& header, const std::string& name_space, int id, int type,
                                      const std_msgs::ColorRGBA& color);

/// An arc (purple) for each sector of `angle_span` (rad) around the heading, as far away as its average; paler where
/// nothing was seen, since its range is only the cap.
visualization_msgs::Marker makeSectorMarker(const std_msgs::Header& header, const Pose2& pose, const Sectors& sectors,
                                            double angle_span);

/// A red line; rviz is told to delete it while it has fewer than two points, which it reports as an error.
template <typename Points>
visualization_msgs::Marker makeTraceMarker(const std_msgs::Header& header, const std::string& name_space,
                                           const Points& points) {
  using visualization_msgs::Marker;
  Marker line = makeMarker(header, name_space, 0, Marker::LINE_STRIP, makeColor(0.9, 0.0, 0.0));
  line.scale.x = 0.05;
  for (const Point2& position : points) {
    line.points.push_back(makePoint(position, kTraceHeight));
  }
  line.action = line.points.size() < 2 ? static_cast<int>(Marker::DELETE) : static_cast<int>(Marker::ADD);
  return line;
}

/// Adds an arrow of three lines to a LINE_LIST: a marker of its own for each of some hundred arrows is too much for
/// rviz. `angle`: rad from the heading.
void addArrow(const Pose2& pose, double angle, double length, double height, const std_msgs::ColorRGBA& color,
              visualization_msgs::Marker* lines);

/// Adds a green disc with an arrow for the heading, in the name space "goal".
void addGoalMarkers(const std_msgs::Header& header, const Pose2& goal, visualization_msgs::MarkerArray* markers);

}  // namespace lstm_planner
