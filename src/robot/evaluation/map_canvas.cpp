#include "robot/evaluation/map_canvas.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace lstm_planner {
namespace {

const cv::Scalar kFree(255, 255, 255);
const cv::Scalar kUnknown(205, 205, 205);
const cv::Scalar kObstacle(40, 40, 40);

constexpr int kSubpixelBits = 4;
constexpr double kSubpixels = 1 << kSubpixelBits;

}  // namespace

MapCanvas::MapCanvas(const OccupancyGrid& map, int longest_side)
    : map_(map), scale_(std::max(1.0, std::floor(longest_side / double(std::max(map.columns(), map.rows()))))) {
  cv::Mat cells(map.rows(), map.columns(), CV_8UC3);
  for (int row = 0; row < map.rows(); ++row) {
    for (int column = 0; column < map.columns(); ++column) {
      const Cell cell = map.at({column, row});
      const cv::Scalar& color = cell == Cell::kOccupied ? kObstacle : cell == Cell::kFree ? kFree : kUnknown;
      cells.at<cv::Vec3b>(map.rows() - 1 - row, column) =
          cv::Vec3b(static_cast<uchar>(color[0]), static_cast<uchar>(color[1]), static_cast<uchar>(color[2]));
    }
  }
  cv::resize(cells, image_, cv::Size(), scale_, scale_, cv::INTER_NEAREST);
  const int longest = std::max(image_.cols, image_.rows);
  if (longest > longest_side) {
    // Huge maps: thin walls must not vanish between the pixels.
    scale_ = longest_side / static_cast<double>(longest);
    cv::resize(cells, image_, cv::Size(), scale_, scale_, cv::INTER_AREA);
  }
  unit_ = std::max(image_.cols, image_.rows) / 1000.0;
  map_rows_ = image_.rows;
}

int MapCanvas::line(double width) const { return std::max(1, static_cast<int>(std::lround(width * unit_))); }

cv::Point MapCanvas::at(const Point2& point) const {
  const Point2 local = toLocalFrame(map_.origin(), point);
  const double column = pixelsOf(local.x) - 0.5;
  const double row = static_cast<double>(map_rows_) - pixelsOf(local.y) - 0.5;
  return {cv::saturate_cast<int>(column * kSubpixels), cv::saturate_cast<int>(row * kSubpixels)};
}

cv::Point MapCanvas::pixelAt(const Point2& point) const {
  const cv::Point fine = at(point);
  return {fine.x >> kSubpixelBits, fine.y >> kSubpixelBits};
}

void MapCanvas::polyline(const std::vector<Point2>& points, const cv::Scalar& color, double width) {
  std::vector<cv::Point> pixels;
  for (const Point2& point : points) pixels.push_back(at(point));
  if (pixels.empty()) return;
  cv::polylines(image_, pixels, false, color, line(width), cv::LINE_AA, kSubpixelBits);
}

void MapCanvas::circle(const Point2& center, double radius, const cv::Scalar& color, int thickness) {
  const int size = static_cast<int>(std::max(pixelsOf(radius), 3.0 * unit_) * kSubpixels);
  cv::circle(image_, at(center), size, color, thickness, cv::LINE_AA, kSubpixelBits);
}

void MapCanvas::cross(const Point2& center, double radius, const cv::Scalar& color, double width) {
  const double reach = std::max(radius, 4.0 * unit_ / pixelsOf(1.0)) * std::sqrt(0.5);
  for (const double side : {1.0, -1.0}) {
    polyline({{center.x - reach, center.y - side * reach}, {center.x + reach, center.y + side * reach}}, color, width);
  }
}

cv::Size MapCanvas::sizeOf(const std::string& text) const {
  int baseline = 0;
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.6 * std::max(1.0, unit_), line(1.2), &baseline);
}

void MapCanvas::text(const cv::Point& position, const std::string& text, const cv::Scalar& color) {
  const double size = 0.6 * std::max(1.0, unit_);
  const int width = line(1.2);
  const cv::Size extent = sizeOf(text);
  const int below = extent.height / 2;
  const cv::Point inside(std::max(width, std::min(position.x, image_.cols - extent.width - width)),
                         std::max(extent.height + width, std::min(position.y, image_.rows - below)));
  // A white rim keeps it readable over walls and traces.
  cv::putText(image_, text, inside, cv::FONT_HERSHEY_SIMPLEX, size, kFree, 5 * width, cv::LINE_AA);
  cv::putText(image_, text, inside, cv::FONT_HERSHEY_SIMPLEX, size, color, width, cv::LINE_AA);
}

int MapCanvas::addStrip(int height) {
  const int first = image_.rows;
  cv::Mat extended;
  cv::copyMakeBorder(image_, extended, 0, height, 0, 0, cv::BORDER_CONSTANT, kFree);
  image_ = extended;
  return first;
}

}  // namespace lstm_planner
