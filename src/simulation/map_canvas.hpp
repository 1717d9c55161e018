#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "lstm_planner/common/canvas.hpp"
#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/decision/decision.hpp"
#include "lstm_planner/grid/occupancy_grid.hpp"

namespace lstm_planner {

namespace colours {

// Of all pictures of drives: blue, green, red.
inline const cv::Scalar kFree(255, 255, 255);
inline const cv::Scalar kUnknown(205, 205, 205);
inline const cv::Scalar kObstacle(40, 40, 40);
inline const cv::Scalar kStart(130, 40, 0);  ///< and the robot
inline const cv::Scalar kGoal(60, 160, 30);
inline const cv::Scalar kMissedGoal(0, 140, 255);

}  // namespace colours

/// In which colour the path is drawn that was chosen so, along the remembered path or not; blue, green, red.
inline cv::Scalar colorOf(Decision::Choice choice, bool on_path = true) {
  if (choice.move != Decision::Move::kStep) return {130, 130, 130};
  switch (choice.by) {
    case Leader::kNetwork:
      return on_path ? cv::Scalar(40, 40, 220) : cv::Scalar(0, 150, 255);
    case Leader::kGreedy:
      return {170, 60, 120};
    case Leader::kRoute:
      return {235, 130, 20};
    case Leader::kEscape:
      return {150, 150, 0};
  }
  return {130, 130, 130};
}

/// The map's cells as a picture, row 0 at the bottom, and the path from the map frame into it. Colours are blue, green,
/// red; positions and radii are in the map frame, m; widths are in thousandths of the longer side.
class MapCanvas {
 public:
  MapCanvas(const OccupancyGrid& map, int longest_side);

  cv::Mat& image() { return canvas_.image(); }
  double unit() const { return unit_; }  ///< pixels, a thousandth of the map's longer side
  int line(double width) const;          ///< pixels, 1 or more
  double pixelsOf(double metres) const { return metres / map_.resolution() * canvas_.scale(); }
  cv::Point pixelAt(const Point2& point) const;

  void polyline(const std::vector<Point2>& points, const cv::Scalar& color, double width);
  void circle(const Point2& center, double radius, const cv::Scalar& color, int thickness);
  void cross(const Point2& center, double radius, const cv::Scalar& color, double width);
  /// With a white rim; moved into the picture when it would stick out.
  void text(const cv::Point& position, const std::string& text, const cv::Scalar& color);
  cv::Size sizeOf(const std::string& text) const;  ///< pixels

  /// Adds a white strip of that many pixels below the map; returns its first row.
  int addStrip(int height);

 private:
  cv::Point at(const Point2& point) const;  ///< a fine place
  double textSize() const;

  const OccupancyGrid& map_;
  Canvas canvas_;
  double unit_;
  int map_rows_;  ///< pixels
};

}  // namespace lstm_planner
