#include "lstm_planner/evaluation/trace_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "evaluation/map_canvas.hpp"

namespace lstm_planner {
namespace {

const cv::Scalar kPaper(255, 255, 255);  // colours are blue, green, red
const cv::Scalar kObstacle(40, 40, 40);
const cv::Scalar kTrace(40, 40, 220);
const cv::Scalar kEscape(235, 130, 20);
const cv::Scalar kWalker(165, 150, 120);
const cv::Scalar kStart(130, 40, 0);
const cv::Scalar kReached(60, 160, 30);
const cv::Scalar kMissed(0, 140, 255);
const cv::Scalar kContact(200, 0, 200);
const cv::Scalar kText(0, 0, 0);

constexpr double kTraceWidth = 2.0;  // thousandths of the longer side
constexpr double kWalkerWidth = 1.0;
constexpr double kWalkerRadius = 0.25;  // m

void drawStart(const Pose2& start, double radius, MapCanvas* canvas) {
  canvas->circle({start.x, start.y}, radius, kStart, canvas->line(2.0));
  canvas->polyline({{start.x, start.y}, pointAlong(start, start.yaw, 1.8 * radius)}, kStart, 2.0);
}

void drawGoal(const TracePicture::Goal& goal, double radius, MapCanvas* canvas) {
  const cv::Scalar& color = goal.reached ? kReached : kMissed;
  canvas->circle(goal.position, 0.6 * radius, color, cv::FILLED);
  if (!goal.reached) canvas->cross(goal.position, 2.0 * radius, color, 2.0);
  if (goal.label.empty()) return;
  const double away = std::max(canvas->pixelsOf(radius), 4.0 * canvas->unit()) + 3.0 * canvas->unit();
  const cv::Point above(static_cast<int>(0.5 * away), static_cast<int>(-away));
  canvas->text(canvas->pixelAt(goal.position) + above, goal.label, color);
}

void drawScale(MapCanvas* canvas) {
  double length = 1.0;
  while (canvas->pixelsOf(length) < 80.0 * canvas->unit()) length *= length == 2.0 ? 2.5 : 2.0;
  char label[32];
  std::snprintf(label, sizeof(label), "%g m", length);
  const int margin = canvas->line(14.0);
  const cv::Point left(margin, canvas->image().rows - margin);
  const cv::Point right(margin + static_cast<int>(canvas->pixelsOf(length)), left.y);
  const int rim = canvas->line(5.0);
  const int height = canvas->line(30.0);
  cv::rectangle(canvas->image(), {left.x - rim, left.y - height}, {right.x + rim, right.y + rim}, kPaper, cv::FILLED);
  cv::line(canvas->image(), left, right, kText, canvas->line(2.0));
  canvas->text(left + cv::Point(rim, -rim), label, kText);
}

void drawWalkers(const TracePicture& picture, MapCanvas* canvas) {
  for (const std::vector<Point2>& walker : picture.walkers) {
    canvas->polyline(walker, kWalker, kWalkerWidth);
    if (!walker.empty()) canvas->circle(walker.back(), kWalkerRadius, kWalker, canvas->line(1.5));
  }
}

/// A line or a disc of a colour, and what it means.
struct LegendEntry {
  std::string text;
  cv::Scalar color;
  bool is_line = true;
};

/// Only of what there is in the picture.
std::vector<LegendEntry> legendOf(const TracePicture& picture) {
  std::vector<LegendEntry> entries;
  const auto add = [&](bool there, const char* text, const cv::Scalar& color, bool is_line) {
    if (there) entries.push_back({text, color, is_line});
  };
  const auto isReached = [](const TracePicture::Goal& goal) { return goal.reached; };
  const auto& goals = picture.goals;
  add(!picture.starts.empty(), "start", kStart, false);
  add(std::any_of(goals.begin(), goals.end(), isReached), "goal", kReached, false);
  add(!std::all_of(goals.begin(), goals.end(), isReached), "goal, missed", kMissed, false);
  add(!picture.traces.empty(), "driven", kTrace, true);
  add(!picture.escapes.empty(), "driven by the escape", kEscape, true);
  add(!picture.walkers.empty(), "people", kWalker, true);
  add(!picture.contacts.empty(), "contact", kContact, false);
  return entries;
}

/// Title and legend below the map, as many lines as they need.
void drawStrip(const TracePicture& picture, MapCanvas* canvas) {
  const int gap = canvas->sizeOf("m").width;
  const int line_height = 3 * canvas->sizeOf("M").height;
  const int mark = 3 * gap;
  const std::vector<LegendEntry> entries = picture.legend ? legendOf(picture) : std::vector<LegendEntry>();
  const auto widthOf = [&](const LegendEntry& entry) { return mark + canvas->sizeOf(entry.text).width + 3 * gap; };
  int lines = (picture.title.empty() ? 0 : 1) + (entries.empty() ? 0 : 1);
  int right = gap;
  for (const LegendEntry& entry : entries) {
    const bool wraps = right > gap && right + widthOf(entry) > canvas->image().cols;
    lines += wraps ? 1 : 0;
    right = (wraps ? gap : right) + widthOf(entry);
  }
  if (lines == 0) return;
  int baseline = canvas->addStrip(lines * line_height + line_height / 3) + 2 * line_height / 3;
  if (!picture.title.empty()) {
    canvas->text({gap, baseline}, picture.title, kText);
    baseline += line_height;
  }
  right = gap;
  for (const LegendEntry& entry : entries) {
    if (right > gap && right + widthOf(entry) > canvas->image().cols) {
      right = gap;
      baseline += line_height;
    }
    const int middle = baseline - line_height / 6;
    if (entry.is_line) {
      cv::line(canvas->image(), {right, middle}, {right + 2 * gap, middle}, entry.color, canvas->line(3.0),
               cv::LINE_AA);
    } else {
      cv::circle(canvas->image(), {right + gap, middle}, line_height / 5, entry.color, cv::FILLED, cv::LINE_AA);
    }
    canvas->text({right + mark, baseline}, entry.text, kText);
    right += widthOf(entry);
  }
}

}  // namespace

void writeTracePicture(const std::string& path, const OccupancyGrid& map, const TracePicture& picture,
                       int longest_side) {
  if (map.columns() == 0 || map.rows() == 0) throw std::invalid_argument("an empty map cannot be drawn");
  if (longest_side < 16) {
    throw std::invalid_argument("longest_side is " + std::to_string(longest_side) + ", expected 16 pixels or more");
  }
  MapCanvas canvas(map, longest_side);
  for (const Circle& circle : picture.circles) canvas.circle(circle.center, circle.radius, kObstacle, cv::FILLED);
  drawWalkers(picture, &canvas);
  for (const std::vector<Point2>& trace : picture.traces) canvas.polyline(trace, kTrace, kTraceWidth);
  for (const std::vector<Point2>& escape : picture.escapes) canvas.polyline(escape, kEscape, kTraceWidth);
  for (const Pose2& start : picture.starts) drawStart(start, picture.robot_radius, &canvas);
  for (const TracePicture::Goal& goal : picture.goals) drawGoal(goal, picture.robot_radius, &canvas);
  for (const Point2& contact : picture.contacts) canvas.cross(contact, picture.robot_radius, kContact, 2.5);
  drawScale(&canvas);
  drawStrip(picture, &canvas);
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
