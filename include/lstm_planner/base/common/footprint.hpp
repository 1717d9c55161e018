#pragma once

#include <string>
#include <vector>

#include "lstm_planner/base/common/geometry.hpp"

namespace lstm_planner {

/// What a robot covers of the floor, in its base frame: a circle around the frame's origin, or a convex polygon around
/// it, which need not be centred.
class Footprint {
 public:
  /// A circle, m. Throws std::invalid_argument unless the radius is positive and finite.
  explicit Footprint(double radius);

  /// The convex hull of the points (m). Throws std::invalid_argument for fewer than three corners, points that are not
  /// finite or farther away than 100 m, and a hull that the base frame's origin does not lie inside of.
  explicit Footprint(const std::vector<Point2>& points);

  bool isCircle() const { return corners_.empty(); }
  /// Of the polygon, counter-clockwise; none of a circle.
  const std::vector<Point2>& corners() const { return corners_; }

  /// Of the largest circle around the origin that lies inside, m.
  double inscribedRadius() const { return inscribed_; }
  /// Of the smallest circle around the origin that holds all of it, m.
  double circumscribedRadius() const { return circumscribed_; }
  /// Half the width that it needs to go straight on, m: how far it reaches to the left or right, whichever is farther.
  double passingRadius() const { return passing_; }

  /// Larger by that much on all sides, m; corners stay corners.
  Footprint grown(double margin) const;

  /// From a point in the base frame to its edge, m; negative inside.
  double distanceTo(const Point2& point) const;

 private:
  std::vector<Point2> corners_;
  double inscribed_ = 0.0;
  double circumscribed_ = 0.0;
  double passing_ = 0.0;
};

/// The footprint that two parameters tell: `text` as in costmap_2d, "[[x, y], [x, y], ...]" in m, or where that is
/// empty the circle. Throws std::invalid_argument naming the parameter `name`, its value and what was expected.
Footprint footprintOf(const std::string& name, double radius, const std::string& text);

/// The corners as footprintOf() reads them; empty for a circle.
std::string textOf(const Footprint& footprint);

}  // namespace lstm_planner
