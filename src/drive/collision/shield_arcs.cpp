#include <algorithm>
#include <cmath>

#include "drive/collision/footprint_sweep.hpp"
#include "drive/collision/shield_groups.hpp"
#include "lstm_planner/common/arc.hpp"
#include "lstm_planner/drive/collision/shield.hpp"

namespace lstm_planner {

namespace {

/// Below this, 1/m, an arc of the lengths that matter here is a straight line to a millionth of a millimetre.
constexpr double kStraightCurvature = 1e-9;

/// An arc in the frame of the pose that it starts at, mirrored where needed so that it bends to the left.
struct Arc {
  explicit Arc(double curvature) : radius(1.0 / std::abs(curvature)), mirror(curvature < 0.0 ? -1.0 : 1.0) {}

  /// A point as the arc's centre sees it.
  struct View {
    double beyond;  ///< m, distance from the centre less the radius
    double length;  ///< m of arc, in [0, whole circle), to where the arc is nearest to the point
  };
  View viewOf(const Point2& point) const {
    const double y = mirror * point.y;
    const double from_center = std::hypot(point.x, radius - y);
    // Not from_center - radius: of an arc that is nearly straight nothing would be left of the difference.
    const double beyond = (square(point.x) + square(y) - 2.0 * radius * y) / (from_center + radius);
    const double angle = std::atan2(point.x, radius - y);
    return {beyond, radius * (angle < 0.0 ? angle + 2.0 * M_PI : angle)};
  }

  double radius;  ///< m
  double mirror;
};

}  // namespace

double Shield::freeArc(const Pose2& from, double curvature, double limit, double clearance) const {
  if (!footprint_.isCircle()) {
    return sweep(FootprintSweep::arc(footprint_, curvature, false), from, limit, clearance);
  }
  if (std::abs(curvature) < kStraightCurvature) {
    return freeDistance({from.x, from.y}, from.yaw, limit, clearance);
  }
  const Arc arc(curvature);
  const double wanted = footprint_radius_ + clearance;
  const double hard = footprint_radius_ + std::min(hard_margin_, clearance);
  const double c = std::cos(from.yaw);
  const double s = std::sin(from.yaw);
  double free = limit;
  visitNear({from.x, from.y}, wanted + limit, [&](const Point2& obstacle) {
    const double dx = obstacle.x - from.x;
    const double dy = obstacle.y - from.y;
    const double squared = square(dx) + square(dy);
    if (squared >= square(wanted + free)) {
      return false;
    }
    const Point2 local{c * dx + s * dy, c * dy - s * dx};
    const double now = std::sqrt(squared);
    if (now <= hard && local.x > 0.0) {
      free = 0.0;
      return true;
    }
    // One that it goes away from may come back to where it is now, after a turn.
    const double radius = now <= hard ? now : std::max(hard, std::min(wanted, now - kShieldTouchSlack));
    const Arc::View view = arc.viewOf(local);
    if (std::abs(view.beyond) >= radius) {
      return false;
    }
    // The chord from the nearest place of the arc to where the point is `radius` away, by the law of cosines.
    const double half_chord =
        0.5 * std::sqrt((square(radius) - square(view.beyond)) / (arc.radius * (arc.radius + view.beyond)));
    const double before = 2.0 * arc.radius * std::asin(std::min(1.0, half_chord));
    free = std::min(free, std::max(0.0, view.length - before));
    return false;
  });
  return free;
}

double Shield::arcGap(const Pose2& from, double curvature, double length) const {
  if (!footprint_.isCircle()) {
    return sweepGap(FootprintSweep::arc(footprint_, curvature, false), from, length);
  }
  const Pose2 end = alongArc(from, curvature, length);
  const bool straight = std::abs(curvature) < kStraightCurvature;
  const Arc arc(straight ? 1.0 : curvature);
  const Point2 start{from.x, from.y};
  double nearest_so_far = nearest(start);
  visitNear(start, length + nearest_so_far, [&](const Point2& obstacle) {
    const double now = distanceBetween(from, obstacle);
    if (now - length >= nearest_so_far) {
      return false;
    }
    nearest_so_far = std::min(nearest_so_far, distanceBetween(end, obstacle));
    const Point2 local = toLocalFrame(from, obstacle);
    const Arc::View view = straight ? Arc::View{local.y, local.x} : arc.viewOf(local);
    if (view.length >= 0.0 && view.length <= length) {
      nearest_so_far = std::min(nearest_so_far, std::abs(view.beyond));
    }
    return false;
  });
  return nearest_so_far - footprint_radius_;
}

}  // namespace lstm_planner
