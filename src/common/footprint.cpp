#include "lstm_planner/common/footprint.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>

#include "lstm_planner/common/segment.hpp"
#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {

namespace {

constexpr double kFarthest = 100.0;  // m
constexpr double kSmallest = 0.005;  // m, of the inscribed circle

std::vector<Point2> hullOf(const std::vector<Point2>& points) {
  std::vector<cv::Point2f> all;
  for (const Point2& point : points) {
    if (!(std::hypot(point.x, point.y) <= kFarthest)) {
      throw std::invalid_argument("a corner is at (" + numberText(point.x) + ", " + numberText(point.y) +
                                  "), expected one within 100 m of the robot's middle");
    }
    all.emplace_back(static_cast<float>(point.x), static_cast<float>(point.y));
  }
  std::vector<int> chosen;
  if (all.size() >= 3) cv::convexHull(all, chosen);
  if (chosen.size() < 3) throw std::invalid_argument("expected at least three corners that are not in one line");
  std::vector<Point2> corners;
  double area = 0.0;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Point2& from = points[static_cast<std::size_t>(chosen[i])];
    const Point2& to = points[static_cast<std::size_t>(chosen[(i + 1) % chosen.size()])];
    corners.push_back(from);
    area += from.x * to.y - to.x * from.y;
  }
  if (area < 0.0) std::reverse(corners.begin(), corners.end());
  return corners;
}

}  // namespace

Footprint::Footprint(double radius) : inscribed_(radius), circumscribed_(radius), passing_(radius) {
  if (!(radius > 0.0) || !std::isfinite(radius)) {
    throw std::invalid_argument("the footprint's radius is " + numberText(radius) + ", expected a positive number");
  }
}

Footprint::Footprint(const std::vector<Point2>& points) : corners_(hullOf(points)) {
  for (const Point2& corner : corners_) {
    circumscribed_ = std::max(circumscribed_, std::hypot(corner.x, corner.y));
    passing_ = std::max(passing_, std::abs(corner.y));
  }
  inscribed_ = -distanceTo({});
  if (inscribed_ < kSmallest) {
    throw std::invalid_argument("expected corners around the robot's middle, the origin of its base frame");
  }
}

Footprint Footprint::grown(double margin) const {
  if (isCircle()) return Footprint(inscribed_ + margin);
  std::vector<Point2> moved;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Point2& before = corners_[(i + corners_.size() - 1) % corners_.size()];
    const Point2& corner = corners_[i];
    const Point2& after = corners_[(i + 1) % corners_.size()];
    // Where the two sides meet that lie `margin` outside of those at the corner.
    const double first = directionTo(before, corner) - M_PI_2;
    const double half = 0.5 * normalizeAngle(directionTo(corner, after) - M_PI_2 - first);
    moved.push_back(pointAlong(corner, first + half, margin / std::cos(half)));
  }
  return Footprint(moved);
}

double Footprint::distanceTo(const Point2& point) const {
  if (isCircle()) return std::hypot(point.x, point.y) - inscribed_;
  double outside = std::numeric_limits<double>::infinity();  // m^2
  double beyond = -outside;                                  // m, farthest beyond a side's line
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Point2& from = corners_[i];
    const Point2& to = corners_[(i + 1) % corners_.size()];
    const double cross = (to.x - from.x) * (point.y - from.y) - (to.y - from.y) * (point.x - from.x);
    beyond = std::max(beyond, -cross / distanceBetween(from, to));
    outside = std::min(outside, squaredDistanceToSegment(point, from, to));
  }
  return beyond <= 0.0 ? beyond : std::sqrt(outside);
}

Footprint footprintOf(const std::string& name, double radius, const std::string& text) {
  if (text.empty()) return Footprint(radius);
  try {
    std::vector<Point2> corners;
    const YAML::Node list = YAML::Load(text);
    if (!list.IsSequence()) throw std::invalid_argument("expected [[x, y], [x, y], [x, y], ...] in m");
    for (const YAML::Node& corner : list) {
      const auto numbers = corner.as<std::vector<double>>();
      if (numbers.size() != 2) throw std::invalid_argument("expected two numbers a corner");
      corners.push_back({numbers[0], numbers[1]});
    }
    return Footprint(corners);
  } catch (const YAML::Exception&) {
    throw std::invalid_argument("parameter " + name + " is '" + text +
                                "', expected [[x, y], [x, y], [x, y], ...] in m");
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("parameter " + name + " is '" + text + "': " + error.what());
  }
}

double reachBeyond(const Footprint& footprint, const std::vector<Point2>& points) {
  constexpr double kSame = 0.002;  // m
  double beyond = 0.0;
  for (const Point2& point : points) beyond = std::max(beyond, footprint.distanceTo(point));
  return beyond > kSame ? beyond : 0.0;
}

std::vector<Point2> costmapCircle(double radius) {
  constexpr int kCorners = 16;
  std::vector<Point2> corners;
  for (int i = 0; i < kCorners; ++i) corners.push_back(pointAlong(Point2{}, 2.0 * M_PI * i / kCorners, radius));
  return corners;
}

std::string textOf(const Footprint& footprint) {
  std::ostringstream text;
  for (const Point2& corner : footprint.corners()) {
    text << (text.tellp() > 0 ? ", " : "[") << '[' << corner.x << ", " << corner.y << ']';
  }
  if (!footprint.isCircle()) text << ']';
  return text.str();
}

}  // namespace lstm_planner
