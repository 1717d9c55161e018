#include "lstm_planner/drive/collision/shield.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "drive/collision/footprint_sweep.hpp"
#include "lstm_planner/common/arc.hpp"
#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A return must come this much nearer before it counts as coming nearer, m: less than the noise of any scanner.
constexpr double kTouchSlack = 1e-3;

constexpr std::size_t kReturnsAGroup = 16;

constexpr double kEdgeRounding = 1e-6;  // m

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

Shield::Shield(const Footprint& footprint, double hard_margin, double reach)
    : footprint_(footprint),
      footprint_radius_(footprint.circumscribedRadius()),
      hard_margin_(hard_margin),
      reach_(reach) {
  if (!(hard_margin >= 0.0) || !(reach > footprint_radius_ + hard_margin)) {
    throw std::invalid_argument("the footprint radius is " + numberText(footprint_radius_) + ", the hard margin " +
                                numberText(hard_margin) + " and the reach " + numberText(reach) +
                                ", expected 0 < radius, 0 <= margin, radius + margin < reach");
  }
}

void Shield::show(const std::vector<Point2>& obstacles) {
  returns_.clear();
  groups_.clear();
  add(obstacles);
}

void Shield::moveTo(const Pose2& pose) { show(toParentFrame(inverse(pose), returns_)); }

void Shield::add(const std::vector<Point2>& obstacles) {
  returns_.reserve(returns_.size() + obstacles.size());
  groups_.reserve(returns_.capacity() / kReturnsAGroup + 1);
  for (const Point2& place : obstacles) {
    if (!(square(place.x) + square(place.y) <= square(reach_))) continue;
    const std::size_t first = groups_.size() < 2 ? 0 : groups_[groups_.size() - 2].end;
    if (groups_.empty() || groups_.back().end - first == kReturnsAGroup) groups_.push_back({place, place, 0});
    Group& group = groups_.back();
    group.low = {std::min(group.low.x, place.x), std::min(group.low.y, place.y)};
    group.high = {std::max(group.high.x, place.x), std::max(group.high.y, place.y)};
    returns_.push_back(place);
    group.end = returns_.size();
  }
}

template <typename Visit>
void Shield::visitNear(const Point2& from, double distance, const Visit& visit) const {
  std::size_t next = 0;
  for (const Group& group : groups_) {
    const bool is_far = group.low.x - from.x > distance || from.x - group.high.x > distance ||
                        group.low.y - from.y > distance || from.y - group.high.y > distance;
    if (is_far) next = group.end;
    for (; next < group.end; ++next) {
      if (visit(returns_[next])) return;
    }
  }
}

double Shield::freeDistance(const Point2& from, double direction, double limit, double clearance) const {
  if (!footprint_.isCircle()) return freeArc({from.x, from.y, direction}, 0.0, limit, clearance);
  const Point2 along{std::cos(direction), std::sin(direction)};
  const double wanted = footprint_radius_ + clearance;
  const double hard = footprint_radius_ + std::min(hard_margin_, clearance);
  double free = limit;
  visitNear(from, wanted + limit, [&](const Point2& obstacle) {
    const double dx = obstacle.x - from.x;
    const double dy = obstacle.y - from.y;
    const double ahead = along.x * dx + along.y * dy;
    const double aside = std::abs(along.x * dy - along.y * dx);
    if (ahead <= 0.0 || aside >= wanted || ahead - wanted >= free) return false;
    const double now = std::sqrt(square(ahead) + square(aside));
    if (now <= hard) {
      free = 0.0;
      return true;
    }
    const double radius = std::max(hard, std::min(wanted, now - kTouchSlack));
    if (aside < radius) free = std::min(free, std::max(0.0, ahead - std::sqrt(square(radius) - square(aside))));
    return false;
  });
  return free;
}

double Shield::gap(const Point2& from) const {
  if (!footprint_.isCircle()) return arcGap({from.x, from.y, 0.0}, 0.0, 0.0);
  return nearest(from) - footprint_radius_;
}

double Shield::nearest(const Point2& from) const {
  double squared = square(reach_ + footprint_radius_);
  for (const Point2& obstacle : returns_) {
    squared = std::min(squared, square(obstacle.x - from.x) + square(obstacle.y - from.y));
  }
  return std::sqrt(squared);
}

double Shield::sweep(const FootprintSweep& sweep, const Pose2& from, double limit, double clearance) const {
  const double hard = std::min(hard_margin_, clearance);
  const double c = std::cos(from.yaw);
  const double s = std::sin(from.yaw);
  const double around = footprint_radius_ + clearance;
  double free = limit;
  visitNear({from.x, from.y}, around + sweep.pathOf(limit), [&](const Point2& obstacle) {
    const double dx = obstacle.x - from.x;
    const double dy = obstacle.y - from.y;
    const double farthest = around + sweep.pathOf(free);
    if (dx * dx + dy * dy >= farthest * farthest) return false;
    const Point2 local{c * dx + s * dy, c * dy - s * dx};
    const double now = sweep.distanceTo(local);
    if (now <= hard && sweep.comesNearer(local)) {
      free = 0.0;
      return true;
    }
    // One that it goes away from may come back to where it is now, after a turn.
    const double nearest = now <= hard ? now - kEdgeRounding : std::max(hard, std::min(clearance, now - kTouchSlack));
    if (nearest > 0.0) free = std::min(free, sweep.freeBefore(local, nearest, free));
    return false;
  });
  return free;
}

double Shield::freeTurn(const Pose2& from, double angle, double clearance) const {
  if (footprint_.isCircle()) return std::abs(angle);
  return sweep(FootprintSweep::turn(footprint_, angle > 0.0), from, std::abs(angle), clearance);
}

double Shield::sweepGap(const FootprintSweep& sweep, const Pose2& from, double length) const {
  double nearest = reach_;
  visitNear({from.x, from.y}, footprint_radius_ + length + reach_, [&](const Point2& obstacle) {
    const double farthest = nearest + footprint_radius_ + length;
    const double dx = obstacle.x - from.x;
    const double dy = obstacle.y - from.y;
    if (dx * dx + dy * dy < farthest * farthest) {
      nearest = std::min(nearest, sweep.leastDistance(toLocalFrame(from, obstacle), length));
    }
    return nearest <= 0.0;
  });
  return nearest;
}

double Shield::freeArc(const Pose2& from, double curvature, double length, double clearance) const {
  if (!footprint_.isCircle()) {
    return sweep(FootprintSweep::arc(footprint_, curvature, length < 0.0), from, std::abs(length), clearance);
  }
  if (std::abs(curvature) < kStraightCurvature) {
    return freeDistance({from.x, from.y}, from.yaw, length, clearance);
  }
  const Arc arc(curvature);
  const double wanted = footprint_radius_ + clearance;
  const double hard = footprint_radius_ + std::min(hard_margin_, clearance);
  const double c = std::cos(from.yaw);
  const double s = std::sin(from.yaw);
  double free = length;
  visitNear({from.x, from.y}, wanted + length, [&](const Point2& obstacle) {
    const double dx = obstacle.x - from.x;
    const double dy = obstacle.y - from.y;
    const double squared = square(dx) + square(dy);
    if (squared >= square(wanted + free)) return false;
    const Point2 local{c * dx + s * dy, c * dy - s * dx};
    const double now = std::sqrt(squared);
    if (now <= hard && local.x > 0.0) {
      free = 0.0;
      return true;
    }
    // One that it goes away from may come back to where it is now, after a turn.
    const double radius = now <= hard ? now : std::max(hard, std::min(wanted, now - kTouchSlack));
    const Arc::View view = arc.viewOf(local);
    if (std::abs(view.beyond) >= radius) return false;
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
    if (now - length >= nearest_so_far) return false;
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
