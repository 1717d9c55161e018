#include "lstm_planner/simulation/trace_picture.hpp"

#include <algorithm>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/common/picture_file.hpp"
#include "simulation/map_canvas.hpp"

namespace lstm_planner {
namespace {

const cv::Scalar kWalker(165, 150, 120);  // colours are blue, green, red
const cv::Scalar kWalkerBefore(225, 218, 205);
const cv::Scalar kContact(200, 0, 200);
const cv::Scalar kText(0, 0, 0);

constexpr double kPartWidth = 2.0;  // thousandths of the longer side
constexpr double kWalkerWidth = 1.0;
constexpr double kWalkerRadius = 0.25;      // m
constexpr std::size_t kRecentPlaces = 100;  // 10 s

void drawStart(const Pose2& start, double radius, MapCanvas* canvas) {
  canvas->circle({start.x, start.y}, radius, colours::kStart, canvas->line(2.0));
  canvas->polyline({{start.x, start.y}, pointAlong(start, start.yaw, 1.8 * radius)}, colours::kStart, 2.0);
}

void drawGoal(const TracePicture::Goal& goal, double radius, MapCanvas* canvas) {
  const cv::Scalar& color = goal.reached ? colours::kGoal : colours::kMissedGoal;
  canvas->circle(goal.position, 0.6 * radius, color, cv::FILLED);
  if (!goal.reached) canvas->cross(goal.position, 2.0 * radius, color, 2.0);
  if (goal.label.empty()) return;
  const double away = std::max(canvas->pixelsOf(radius), 4.0 * canvas->unit()) + 3.0 * canvas->unit();
  const cv::Point above(static_cast<int>(0.5 * away), static_cast<int>(-away));
  canvas->text(canvas->pixelAt(goal.position) + above, goal.label, color);
}

/// A round length that is easy to see, m.
double scaleOf(const MapCanvas& canvas) {
  double length = 1.0;
  while (canvas.pixelsOf(length) < 80.0 * canvas.unit()) length *= length == 2.0 ? 2.5 : 2.0;
  return length;
}

std::string inMetres(double length) {
  char label[32];
  std::snprintf(label, sizeof(label), "%g m", length);
  return label;
}

/// In the lower left corner of the map.
void drawScale(MapCanvas* canvas) {
  const double length = scaleOf(*canvas);
  const int margin = canvas->line(14.0);
  const cv::Point left(margin, canvas->image().rows - margin);
  const cv::Point right(margin + static_cast<int>(canvas->pixelsOf(length)), left.y);
  const int rim = canvas->line(5.0);
  const int height = canvas->line(30.0);
  cv::rectangle(canvas->image(), {left.x - rim, left.y - height}, {right.x + rim, right.y + rim}, colours::kFree,
                cv::FILLED);
  cv::line(canvas->image(), left, right, kText, canvas->line(2.0));
  canvas->text(left + cv::Point(rim, -rim), inMetres(length), kText);
}

/// Where people went, pale, and where they came from last and are now.
void drawWalkers(const TracePicture& picture, MapCanvas* canvas) {
  for (const std::vector<Point2>& walker : picture.walkers) canvas->polyline(walker, kWalkerBefore, kWalkerWidth);
  for (const std::vector<Point2>& walker : picture.walkers) {
    if (walker.empty()) continue;
    const std::size_t recent = std::min(walker.size(), kRecentPlaces);
    canvas->polyline({walker.end() - static_cast<std::ptrdiff_t>(recent), walker.end()}, kWalker, kWalkerWidth);
    canvas->circle(walker.back(), kWalkerRadius, kWalker, canvas->line(1.5));
  }
}

/// A line (or a disc, when it has no width) of a colour, and what it means.
struct LegendEntry {
  std::string text;
  cv::Scalar color;
  int width = 0;  ///< pixels
};

/// Only of what there is in the picture.
std::vector<LegendEntry> legendOf(const TracePicture& picture, const MapCanvas& canvas) {
  std::vector<LegendEntry> entries;
  const int dash = 2 * canvas.sizeOf("m").width;
  const auto add = [&](bool there, const std::string& text, const cv::Scalar& color, int width) {
    if (there) entries.push_back({text, color, width});
  };
  const auto isReached = [](const TracePicture::Goal& goal) { return goal.reached; };
  const auto& goals = picture.goals;
  add(!picture.starts.empty(), "start", colours::kStart, 0);
  add(std::any_of(goals.begin(), goals.end(), isReached), "goal", colours::kGoal, 0);
  add(!std::all_of(goals.begin(), goals.end(), isReached), "goal, missed", colours::kMissedGoal, 0);
  add(!picture.traces.empty() && picture.parts.empty(), "driven", colorOf(Leader::kNetwork), dash);
  using Move = Decision::Move;
  const auto decided = [&](Decision::Choice choice) {
    return std::any_of(picture.parts.begin(), picture.parts.end(),
                       [choice](const TracePicture::Part& part) { return part.choice == choice; });
  };
  const auto isDetour = [](const TracePicture::Part& part) { return part.choice == Leader::kNetwork && !part.on_path; };
  const auto addChoice = [&](Decision::Choice choice, const char* text) {
    add(decided(choice), text, colorOf(choice), dash);
  };
  addChoice(Leader::kNetwork, "decided by the network");
  add(std::any_of(picture.parts.begin(), picture.parts.end(), isDetour), "by the network, beside the remembered path",
      colorOf(Leader::kNetwork, false), dash);
  addChoice(Leader::kGreedy, "going for the goal");
  addChoice(Leader::kRoute, "decided by the remembered path");
  addChoice(Leader::kEscape, "along a boundary");
  add(decided(Move::kGoalInSight) || decided(Move::kLookAround), "goal in sight, or turning",
      colorOf(Move::kGoalInSight), dash);
  add(!picture.walkers.empty(), "people", kWalker, dash);
  add(!picture.contacts.empty(), "contact", kContact, 0);
  const double scale = scaleOf(canvas);
  add(true, inMetres(scale), kText, static_cast<int>(canvas.pixelsOf(scale)));
  return entries;
}

/// Broken between words where it is wider than the picture.
std::vector<std::string> linesOf(const std::string& text, const MapCanvas& canvas, int width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (lines.empty() || canvas.sizeOf(lines.back() + " " + word).width > width) {
      lines.push_back(word);
    } else {
      lines.back() += " " + word;
    }
  }
  return lines;
}

/// Title and legend below the map, as many lines as they need.
class Strip {
 public:
  Strip(const TracePicture& picture, MapCanvas* canvas)
      : canvas_(*canvas),
        gap_(canvas->sizeOf("m").width),
        line_height_(3 * canvas->sizeOf("M").height),
        title_(linesOf(picture.title, *canvas, canvas->image().cols - 2 * gap_)) {
    if (picture.legend) entries_ = legendOf(picture, *canvas);
  }

  void draw() {
    std::vector<cv::Point> places;  // of the entries, from the left end of the first line
    cv::Point place(gap_, 0);
    for (const LegendEntry& entry : entries_) {
      if (place.x > gap_ && place.x + widthOf(entry) > canvas_.image().cols) place = {gap_, place.y + line_height_};
      places.push_back(place);
      place.x += widthOf(entry);
    }
    const int lines = static_cast<int>(title_.size()) + (entries_.empty() ? 0 : places.back().y / line_height_ + 1);
    if (lines == 0) return;
    cv::Point corner(0, canvas_.addStrip(lines * line_height_ + line_height_ / 3) + 2 * line_height_ / 3);
    for (const std::string& line : title_) {
      canvas_.text(corner + cv::Point(gap_, 0), line, kText);
      corner.y += line_height_;
    }
    for (std::size_t i = 0; i < entries_.size(); ++i) draw(entries_[i], corner + places[i]);
  }

 private:
  int markOf(const LegendEntry& entry) const { return std::max(entry.width, 2 * gap_); }
  int widthOf(const LegendEntry& entry) const {
    return markOf(entry) + gap_ + canvas_.sizeOf(entry.text).width + 2 * gap_;
  }

  void draw(const LegendEntry& entry, const cv::Point& place) {
    const cv::Point middle = place - cv::Point(0, line_height_ / 6);
    if (entry.width > 0) {
      cv::line(canvas_.image(), middle, middle + cv::Point(entry.width, 0), entry.color, canvas_.line(3.0),
               cv::LINE_AA);
    } else {
      cv::circle(canvas_.image(), middle + cv::Point(gap_, 0), line_height_ / 5, entry.color, cv::FILLED, cv::LINE_AA);
    }
    canvas_.text(place + cv::Point(markOf(entry) + gap_, 0), entry.text, kText);
  }

  MapCanvas& canvas_;
  int gap_;
  int line_height_;
  std::vector<std::string> title_;
  std::vector<LegendEntry> entries_;
};

}  // namespace

void goOn(const Point2& place, Decision::Choice choice, bool on_path, std::vector<TracePicture::Part>* parts) {
  if (!parts->empty()) parts->back().path.push_back(place);
  const bool goes_on = !parts->empty() && parts->back().choice == choice && parts->back().on_path == on_path;
  if (!goes_on) parts->push_back({choice, on_path, {place}});
}

void writeTracePicture(const std::string& path, const OccupancyGrid& map, const TracePicture& picture,
                       int longest_side) {
  if (map.columns() == 0 || map.rows() == 0) throw std::invalid_argument("an empty map cannot be drawn");
  MapCanvas canvas(map, longest_side);
  for (const Circle& circle : picture.circles)
    canvas.circle(circle.center, circle.radius, colours::kObstacle, cv::FILLED);
  drawWalkers(picture, &canvas);
  for (const std::vector<Point2>& trace : picture.traces) canvas.polyline(trace, colorOf(Leader::kNetwork), kPartWidth);
  for (const TracePicture::Part& part : picture.parts)
    canvas.polyline(part.path, colorOf(part.choice, part.on_path), kPartWidth);
  for (const Pose2& start : picture.starts) drawStart(start, picture.robot_radius, &canvas);
  for (const TracePicture::Goal& goal : picture.goals) drawGoal(goal, picture.robot_radius, &canvas);
  for (const Point2& contact : picture.contacts) canvas.cross(contact, picture.robot_radius, kContact, 2.5);
  if (!picture.legend) drawScale(&canvas);
  Strip(picture, &canvas).draw();
  writePicture(path, canvas.image());
}

}  // namespace lstm_planner
