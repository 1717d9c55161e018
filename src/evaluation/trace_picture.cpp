#include "lstm_planner/evaluation/trace_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace lstm_planner {
namespace {

const cv::Scalar kFree(255, 255, 255);  // colours are blue, green, red
const cv::Scalar kUnknown(205, 205, 205);
const cv::Scalar kObstacle(40, 40, 40);
const cv::Scalar kTrace(40, 40, 220);
const cv::Scalar kStart(200, 90, 0);
const cv::Scalar kReached(60, 160, 30);
const cv::Scalar kMissed(0, 140, 255);
const cv::Scalar kContact(200, 0, 200);
const cv::Scalar kText(0, 0, 0);

constexpr int kSubpixelBits = 4;
constexpr double kSubpixels = 1 << kSubpixelBits;

/// The map's cells as a picture, row 0 at the bottom, and the way from the map frame into it.
class Canvas {
 public:
  Canvas(const OccupancyGrid& map, int longest_side)
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
  }

  cv::Mat& image() { return image_; }
  int line(double width) const { return std::max(1, static_cast<int>(std::lround(width * unit()))); }
  double unit() const { return std::max(image_.cols, image_.rows) / 1000.0; }
  double pixelsOf(double metres) const { return metres / map_.resolution() * scale_; }

  /// With sub-pixel bits, for OpenCV's `shift`.
  cv::Point at(const Point2& point) const {
    const Point2 local = toLocalFrame(map_.origin(), point);
    const double column = pixelsOf(local.x) - 0.5;
    const double row = static_cast<double>(image_.rows) - pixelsOf(local.y) - 0.5;
    return {cv::saturate_cast<int>(column * kSubpixels), cv::saturate_cast<int>(row * kSubpixels)};
  }
  cv::Point pixelAt(const Point2& point) const {
    const cv::Point fine = at(point);
    return {fine.x >> kSubpixelBits, fine.y >> kSubpixelBits};
  }

  void circle(const Point2& center, double radius, const cv::Scalar& color, int thickness) {
    const int size = static_cast<int>(std::max(pixelsOf(radius), 3.0 * unit()) * kSubpixels);
    cv::circle(image_, at(center), size, color, thickness, cv::LINE_AA, kSubpixelBits);
  }
  void cross(const Point2& center, double radius, const cv::Scalar& color, int thickness) {
    const double reach = std::max(radius, 4.0 * unit() / pixelsOf(1.0)) * std::sqrt(0.5);
    for (const double side : {1.0, -1.0}) {
      cv::line(image_, at({center.x - reach, center.y - side * reach}), at({center.x + reach, center.y + side * reach}),
               color, thickness, cv::LINE_AA, kSubpixelBits);
    }
  }
  /// Moved into the picture when it would stick out.
  void text(const cv::Point& position, const std::string& text, const cv::Scalar& color) {
    const double size = 0.6 * std::max(1.0, unit());
    const int width = line(1.2);
    int baseline = 0;
    const cv::Size extent = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, size, width, &baseline);
    const cv::Point inside(std::max(width, std::min(position.x, image_.cols - extent.width - width)),
                           std::max(extent.height + width, std::min(position.y, image_.rows - baseline)));
    // A white rim keeps it readable over walls and traces.
    cv::putText(image_, text, inside, cv::FONT_HERSHEY_SIMPLEX, size, kFree, 5 * width, cv::LINE_AA);
    cv::putText(image_, text, inside, cv::FONT_HERSHEY_SIMPLEX, size, color, width, cv::LINE_AA);
  }

 private:
  const OccupancyGrid& map_;
  double scale_;
  cv::Mat image_;
};

void drawTraces(const TracePicture& picture, Canvas* canvas) {
  for (const std::vector<Point2>& trace : picture.traces) {
    std::vector<cv::Point> points;
    for (const Point2& point : trace) points.push_back(canvas->at(point));
    if (points.empty()) continue;
    cv::polylines(canvas->image(), points, false, kTrace, canvas->line(1.5), cv::LINE_AA, kSubpixelBits);
  }
}

void drawStart(const Pose2& start, double radius, Canvas* canvas) {
  canvas->circle({start.x, start.y}, radius, kStart, canvas->line(1.5));
  cv::line(canvas->image(), canvas->at({start.x, start.y}), canvas->at(pointAlong(start, start.yaw, 1.6 * radius)),
           kStart, canvas->line(1.5), cv::LINE_AA, kSubpixelBits);
}

void drawGoal(const TracePicture::Goal& goal, double radius, Canvas* canvas) {
  const cv::Scalar& color = goal.reached ? kReached : kMissed;
  canvas->circle(goal.position, 0.6 * radius, color, cv::FILLED);
  if (!goal.reached) canvas->cross(goal.position, 2.0 * radius, color, canvas->line(2.0));
  if (goal.label.empty()) return;
  const double away = std::max(canvas->pixelsOf(radius), 4.0 * canvas->unit()) + 3.0 * canvas->unit();
  const cv::Point above(static_cast<int>(0.5 * away), static_cast<int>(-away));
  canvas->text(canvas->pixelAt(goal.position) + above, goal.label, color);
}

void drawScale(Canvas* canvas) {
  double length = 1.0;
  while (canvas->pixelsOf(length) < 80.0 * canvas->unit()) length *= length == 2.0 ? 2.5 : 2.0;
  char label[32];
  std::snprintf(label, sizeof(label), "%g m", length);
  const int margin = canvas->line(14.0);
  const cv::Point left(margin, canvas->image().rows - margin);
  const cv::Point right(margin + static_cast<int>(canvas->pixelsOf(length)), left.y);
  const int rim = canvas->line(5.0);
  const int height = canvas->line(30.0);
  cv::rectangle(canvas->image(), {left.x - rim, left.y - height}, {right.x + rim, right.y + rim}, kFree, cv::FILLED);
  cv::line(canvas->image(), left, right, kText, canvas->line(2.0));
  canvas->text(left + cv::Point(rim, -rim), label, kText);
}

}  // namespace

void writeTracePicture(const std::string& path, const OccupancyGrid& map, const TracePicture& picture,
                       int longest_side) {
  if (map.columns() == 0 || map.rows() == 0) throw std::invalid_argument("an empty map cannot be drawn");
  if (longest_side < 16) {
    throw std::invalid_argument("longest_side is " + std::to_string(longest_side) + ", expected 16 pixels or more");
  }
  Canvas canvas(map, longest_side);
  drawTraces(picture, &canvas);
  for (const Pose2& start : picture.starts) drawStart(start, picture.robot_radius, &canvas);
  for (const TracePicture::Goal& goal : picture.goals) drawGoal(goal, picture.robot_radius, &canvas);
  for (const Point2& contact : picture.contacts) {
    canvas.cross(contact, picture.robot_radius, kContact, canvas.line(2.5));
  }
  drawScale(&canvas);
  bool written = false;
  try {
    written = cv::imwrite(path, canvas.image());
  } catch (const cv::Exception&) {
    // An extension that OpenCV does not know; said below like any other failure.
  }
  if (!written)
    throw std::runtime_error("picture '" + path + "' cannot be written (expected a path to a .png or .jpg)");
}

}  // namespace lstm_planner
