#include "lstm_planner/agent/shield.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace lstm_planner {

namespace {

/// A return must come this much nearer before it counts as coming nearer: less than the noise of any scanner.
constexpr double kTouchSlack = 1e-3;

/// Below this, 1/m, an arc of the lengths that matter here is a straight line to a millionth of a millimetre.
constexpr double kStraight = 1e-9;

double square(double value) { return value * value; }

/// An arc in the frame of the pose that it begins at, mirrored where needed so that it bends to the left.
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

Pose2 alongArc(const Pose2& from, double curvature, double length) {
  const double half_turn = 0.5 * curvature * length;
  const double chord = std::abs(half_turn) > 1e-9 ? length * std::sin(half_turn) / half_turn : length;
  const Point2 end = pointAlong(from, from.yaw + half_turn, chord);
  return {end.x, end.y, from.yaw + 2.0 * half_turn};
}

Shield::Shield(double footprint_radius, double hard_margin, double reach)
    : footprint_radius_(footprint_radius), hard_margin_(hard_margin), reach_(reach) {
  if (!(footprint_radius > 0.0) || !(hard_margin >= 0.0) || !(reach > footprint_radius + hard_margin)) {
    throw std::invalid_argument("the footprint radius is " + std::to_string(footprint_radius) + ", the hard margin " +
                                std::to_string(hard_margin) + " and the reach " + std::to_string(reach) +
                                ", expected 0 < radius, 0 <= margin, radius + margin < reach");
  }
}

void Shield::show(const std::vector<Point2>& obstacles) {
  obstacles_.clear();
  for (const Point2& obstacle : obstacles) {
    if (obstacle.x * obstacle.x + obstacle.y * obstacle.y <= reach_ * reach_) {
      obstacles_.push_back(obstacle);
    }
  }
}

double Shield::freeDistance(const Point2& from, double direction, double limit, double clearance) const {
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  const double wanted = footprint_radius_ + clearance;
  const double hard = footprint_radius_ + std::min(hard_margin_, clearance);
  double free = limit;
  for (const Point2& obstacle : obstacles_) {
    const double dx = obstacle.x - from.x;
    const double dy = obstacle.y - from.y;
    const double along = c * dx + s * dy;
    const double aside = std::abs(c * dy - s * dx);
    if (along <= 0.0 || aside >= wanted || along - wanted >= free) {
      continue;
    }
    const double now = std::hypot(dx, dy);
    if (now <= hard) {
      return 0.0;
    }
    const double radius = std::max(hard, std::min(wanted, now - kTouchSlack));
    if (aside < radius) {
      free = std::min(free, std::max(0.0, along - std::sqrt(radius * radius - aside * aside)));
    }
  }
  return free;
}

double Shield::freeArc(const Pose2& from, double curvature, double limit, double clearance) const {
  if (std::abs(curvature) < kStraight) {
    return freeDistance({from.x, from.y}, from.yaw, limit, clearance);
  }
  const Arc arc(curvature);
  const double wanted = footprint_radius_ + clearance;
  const double hard = footprint_radius_ + std::min(hard_margin_, clearance);
  const double c = std::cos(from.yaw);
  const double s = std::sin(from.yaw);
  double free = limit;
  for (const Point2& obstacle : obstacles_) {
    const double dx = obstacle.x - from.x;
    const double dy = obstacle.y - from.y;
    const double squared = square(dx) + square(dy);
    if (squared >= square(wanted + free)) {
      continue;
    }
    const Point2 local{c * dx + s * dy, c * dy - s * dx};
    const double now = std::sqrt(squared);
    if (now <= hard && local.x > 0.0) {
      return 0.0;
    }
    // One that it goes away from may come back to where it is now, after a turn.
    const double radius = now <= hard ? now : std::max(hard, std::min(wanted, now - kTouchSlack));
    const Arc::View view = arc.viewOf(local);
    if (std::abs(view.beyond) >= radius) {
      continue;
    }
    // The chord from the nearest place of the arc to where the point is `radius` away, by the law of cosines.
    const double half_chord =
        0.5 * std::sqrt((square(radius) - square(view.beyond)) / (arc.radius * (arc.radius + view.beyond)));
    const double before = 2.0 * arc.radius * std::asin(std::min(1.0, half_chord));
    free = std::min(free, std::max(0.0, view.length - before));
  }
  return free;
}

double Shield::gap(const Point2& from) const {
  double nearest = reach_ + footprint_radius_;
  for (const Point2& obstacle : obstacles_) {
    nearest = std::min(nearest, distanceBetween(from, obstacle));
  }
  return nearest - footprint_radius_;
}

double Shield::arcGap(const Pose2& from, double curvature, double length) const {
  const Pose2 end = alongArc(from, curvature, length);
  const bool straight = std::abs(curvature) < kStraight;
  const Arc arc(straight ? 1.0 : curvature);
  double nearest = reach_ + footprint_radius_;
  for (const Point2& obstacle : obstacles_) {
    const double now = distanceBetween(from, obstacle);
    if (now - length >= nearest) {
      continue;
    }
    nearest = std::min({nearest, now, distanceBetween(end, obstacle)});
    const Point2 local = toLocalFrame(from, obstacle);
    const Arc::View view = straight ? Arc::View{local.y, local.x} : arc.viewOf(local);
    if (view.length >= 0.0 && view.length <= length) {
      nearest = std::min(nearest, std::abs(view.beyond));
    }
  }
  return nearest - footprint_radius_;
}

}  // namespace lstm_planner
