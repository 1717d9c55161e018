#pragma once

#include <string>
#include <vector>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// The outline of a robot in its base frame: a circle around the frame's origin, or a convex polygon that contains the
/// origin.
class Footprint {
 public:
  /// A circle, radius in m. Throws std::invalid_argument unless the radius is positive and finite.
  explicit Footprint(double radius);

  /// The convex hull of the points (m). Throws std::invalid_argument if the hull has fewer than three corners or does
  /// not contain the origin, or if a point is not finite or is farther away than 100 m.
  explicit Footprint(const std::vector<Point2>& points);

  bool isCircle() const { return corners_.empty(); }
  /// The corners of the polygon, m, counter-clockwise; empty for a circle.
  const std::vector<Point2>& corners() const { return corners_; }

  /// Radius of the largest circle around the origin inside the footprint, m.
  double inscribedRadius() const { return inscribed_; }
  /// Radius of the smallest circle around the origin that contains the footprint, m.
  double circumscribedRadius() const { return circumscribed_; }
  /// The larger of the distances that the footprint reaches to the left and to the right, m: half the width that the
  /// robot needs to drive straight on.
  double passingRadius() const { return passing_; }

  /// The footprint with `margin` (m) added on all sides. Corners stay corners.
  Footprint grown(double margin) const;

  /// Distance from a point in the base frame to the edge of the footprint, m; negative inside.
  double distanceTo(const Point2& point) const;

 private:
  std::vector<Point2> corners_;
  double inscribed_ = 0.0;
  double circumscribed_ = 0.0;
  double passing_ = 0.0;
};

/// The footprint that two parameters give: the polygon in `text`, "[[x, y], [x, y], ...]" in m as in costmap_2d, or a
/// circle if `text` is empty. Throws std::invalid_argument naming the parameter `name`, its value and what was
/// expected.
Footprint footprintOf(const std::string& name, double radius, const std::string& text);

/// How far the farthest of some points (base frame, m) lies outside of the footprint, m; 0 where all lie inside, or
/// beyond the edge by no more than robots are measured (2 mm).
double reachBeyond(const Footprint& footprint, const std::vector<Point2>& points);

/// The polygon that costmap_2d has in place of a circle of this radius (m).
std::vector<Point2> costmapCircle(double radius);

/// The corners as text, as footprintOf() reads it; empty for a circle.
std::string textOf(const Footprint& footprint);

}  // namespace lstm_planner
