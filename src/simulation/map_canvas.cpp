#include "simulation/map_canvas.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace lstm_planner {
namespace {

cv::Mat cellsOf(const OccupancyGrid& map) {
  cv::Mat cells(map.rows(), map.columns(), CV_8UC3);
  for (int row = 0; row < map.rows(); ++row) {
    for (int column = 0; column < map.columns(); ++column) {
      const Cell cell = map.at({column, row});
      const cv::Scalar& color = cell == Cell::kOccupied ? colours::kObstacle
                                : cell == Cell::kFree   ? colours::kFree
                                                        : colours::kUnknown;
      cells.at<cv::Vec3b>(map.rows() - 1 - row, column) =
          cv::Vec3b(static_cast<uchar>(color[0]), static_cast<uchar>(color[1]), static_cast<uchar>(color[2]));
    }
  }
  return cells;
}

}  // namespace

MapCanvas::MapCanvas(const OccupancyGrid& map, int longest_side)
    : map_(map),
      canvas_(cellsOf(map), longest_side),
      unit_(std::max(image().cols, image().rows) / 1000.0),
      map_rows_(image().rows) {}

int MapCanvas::line(double width) const { return std::max(1, static_cast<int>(std::lround(width * unit_))); }

cv::Point MapCanvas::at(const Point2& point) const {
  const Point2 local = toLocalFrame(map_.origin(), point);
  const double column = pixelsOf(local.x) - 0.5;
  const double row = static_cast<double>(map_rows_) - pixelsOf(local.y) - 0.5;
  return Canvas::fine(column, row);
}

cv::Point MapCanvas::pixelAt(const Point2& point) const { return Canvas::pixelOf(at(point)); }

void MapCanvas::polyline(const std::vector<Point2>& points, const cv::Scalar& color, double width) {
  std::vector<cv::Point> places;
  for (const Point2& point : points) places.push_back(at(point));
  canvas_.polyline(places, color, line(width));
}

void MapCanvas::circle(const Point2& center, double radius, const cv::Scalar& color, int thickness) {
  canvas_.circle(at(center), std::max(pixelsOf(radius), 3.0 * unit_), color, thickness);
}

void MapCanvas::cross(const Point2& center, double radius, const cv::Scalar& color, double width) {
  const double reach = std::max(radius, 4.0 * unit_ / pixelsOf(1.0)) * std::sqrt(0.5);
  for (const double side : {1.0, -1.0}) {
    polyline({{center.x - reach, center.y - side * reach}, {center.x + reach, center.y + side * reach}}, color, width);
  }
}

double MapCanvas::textSize() const { return 0.6 * std::max(1.0, unit_); }

cv::Size MapCanvas::sizeOf(const std::string& text) const { return sizeOfText(text, textSize(), line(1.2)); }

void MapCanvas::text(const cv::Point& position, const std::string& text, const cv::Scalar& color) {
  const int width = line(1.2);
  const cv::Size extent = sizeOf(text);
  const int below = extent.height / 2;
  const cv::Point inside(std::max(width, std::min(position.x, image().cols - extent.width - width)),
                         std::max(extent.height + width, std::min(position.y, image().rows - below)));
  // A white rim keeps it readable over walls and traces.
  writeText(text, inside, textSize(), colours::kFree, 5 * width, &image());
  writeText(text, inside, textSize(), color, width, &image());
}

int MapCanvas::addStrip(int height) {
  const int first = image().rows;
  cv::Mat extended;
  cv::copyMakeBorder(image(), extended, 0, height, 0, 0, cv::BORDER_CONSTANT, colours::kFree);
  image() = extended;
  return first;
}

}  // namespace lstm_planner
