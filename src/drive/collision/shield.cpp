#include "lstm_planner/drive/collision/shield.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

#include "drive/collision/footprint_sweep.hpp"
#include "drive/collision/shield_groups.hpp"
#include "lstm_planner/common/arc.hpp"

namespace lstm_planner {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A straight drive of a disc: how much of it is free, return by return.
class FreeLine {
 public:
  /// `wanted`: radius with the clearance. `hard`: radius into which nothing may come.
  FreeLine(const Point2& from, const Point2& along, double limit, double wanted, double hard)
      : from_(from),
        along_(along),
        free_(limit),
        wanted_(wanted),
        hard_(hard),
        wanted_squared_(square(wanted)),
        touched_squared_(square(wanted + kShieldTouchSlack)) {}

  double free() const { return free_; }

  /// All with what was free before the group, so that they need not wait for each other.
  void meetGroup(const double* places) {
    double along[kReturnsAGroup];
    double aside[kReturnsAGroup];
    double beside[kReturnsAGroup];  ///< m^2, from the nearest place of what is free so far
    for (std::size_t i = 0; i < kReturnsAGroup; ++i) {
      const double dx = places[i] - from_.x;
      const double dy = places[kReturnsAGroup + i] - from_.y;
      along[i] = along_.x * dx + along_.y * dy;
      aside[i] = std::abs(along_.x * dy - along_.y * dx);
      const double beyond = along[i] - free_;
      beside[i] = square(beyond > 0.0 ? beyond : 0.0) + square(aside[i]);
    }
    // What the disc does not reach before or at the end of what is free so far does not matter.
    for (std::size_t i = 0; i < kReturnsAGroup; ++i) {
      if (beside[i] < wanted_squared_ && along[i] > 0.0) shorten(along[i], aside[i]);
    }
  }

 private:
  void shorten(double along, double aside) {
    double radius = wanted_;
    const double squared = square(along) + square(aside);
    if (squared < touched_squared_) {
      const double now = std::sqrt(squared);
      if (now <= hard_) {
        free_ = 0.0;
        return;
      }
      radius = std::max(hard_, std::min(wanted_, now - kShieldTouchSlack));
    }
    if (aside >= radius) return;
    free_ = std::min(free_, std::max(0.0, along - std::sqrt(square(radius) - square(aside))));
  }

  Point2 from_;
  Point2 along_;  ///< of length 1
  double free_;   ///< m, so far
  double wanted_;
  double hard_;
  double wanted_squared_;
  double touched_squared_;  ///< what is no farther may only come nearer by less than the slack
};

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

Shield::Shield(double footprint_radius, double hard_margin, double reach)
    : Shield(Footprint(footprint_radius), hard_margin, reach) {}

Shield::Shield(const Footprint& footprint, double hard_margin, double reach)
    : footprint_(footprint),
      footprint_radius_(footprint.circumscribedRadius()),
      hard_margin_(hard_margin),
      reach_(reach) {
  if (!(hard_margin >= 0.0) || !(reach > footprint_radius_ + hard_margin)) {
    throw std::invalid_argument("the footprint radius is " + std::to_string(footprint_radius_) + ", the hard margin " +
                                std::to_string(hard_margin) + " and the reach " + std::to_string(reach) +
                                ", expected 0 < radius, 0 <= margin, radius + margin < reach");
  }
}

void Shield::show(const std::vector<Point2>& obstacles) {
  groups_ = 0;
  add(obstacles);
}

void Shield::add(const std::vector<Point2>& obstacles) {
  const std::size_t most = groups_ + (obstacles.size() + kReturnsAGroup - 1) / kReturnsAGroup;
  if (places_.size() < 2 * kReturnsAGroup * most) {
    places_.resize(2 * kReturnsAGroup * most);
    boxes_.resize((most + kGroupsABlock - 1) / kGroupsABlock * kNumbersABlock);
  }
  const std::size_t whole = obstacles.size() / kReturnsAGroup;
  for (std::size_t group = 0; group < whole; ++group) {
    group += addGroups(&obstacles[group * kReturnsAGroup], whole - group, square(reach_));
    if (group < whole) addNear(&obstacles[group * kReturnsAGroup], kReturnsAGroup);
  }
  const std::size_t rest = obstacles.size() % kReturnsAGroup;
  if (rest > 0) addNear(&obstacles[whole * kReturnsAGroup], rest);
}

std::size_t Shield::addGroups(const Point2* obstacles, std::size_t groups, double reach_squared) {
  for (std::size_t group = 0; group < groups; ++group, obstacles += kReturnsAGroup) {
    double* const x = &places_[2 * kReturnsAGroup * groups_];
    double* const y = x + kReturnsAGroup;
    Doubles least = {kInfinity, kInfinity};
    Doubles most = -least;
    for (std::size_t i = 0; i < kReturnsAGroup; ++i) {
      const Doubles place = {obstacles[i].x, obstacles[i].y};
      x[i] = place[0];
      y[i] = place[1];
      least = minimum(place, least);
      most = maximum(place, most);
    }
    const Point2 low{least[0], least[1]};
    const Point2 high{most[0], most[1]};
    const Point2 nearest{std::max({low.x, -high.x, 0.0}), std::max({low.y, -high.y, 0.0})};
    if (square(nearest.x) + square(nearest.y) > reach_squared) continue;
    const Point2 farthest{std::max(-low.x, high.x), std::max(-low.y, high.y)};
    if (!(square(farthest.x) + square(farthest.y) <= reach_squared)) return group;
    float* const box = &boxes_[groups_ / kGroupsABlock * kNumbersABlock + groups_ % kGroupsABlock];
    box[0] = static_cast<float>(0.5 * (low.x + high.x));
    box[kGroupsABlock] = static_cast<float>(0.5 * (low.y + high.y));
    box[2 * kGroupsABlock] = static_cast<float>(0.5 * (high.x - low.x));
    box[3 * kGroupsABlock] = static_cast<float>(0.5 * (high.y - low.y));
    ++groups_;
  }
  return groups;
}

void Shield::addNear(const Point2* obstacles, std::size_t count) {
  Point2 near[kReturnsAGroup];
  const auto isNear = [&](const Point2& place) { return square(place.x) + square(place.y) <= square(reach_); };
  Point2* const end = std::copy_if(obstacles, obstacles + count, near, isNear);
  if (end != near) {
    std::fill(end, near + kReturnsAGroup, near[0]);
    addGroups(near, 1, kInfinity);
  }
}

double Shield::blur(const Point2& from) const { return 1e-6 * (1.0 + reach_ + std::abs(from.x) + std::abs(from.y)); }

double Shield::freeLine(const Point2& from, double direction, double limit, double clearance, double enough) const {
  if (!footprint_.isCircle()) return freeArc({from.x, from.y, direction}, 0.0, limit, clearance);
  const Point2 along{std::cos(direction), std::sin(direction)};
  const double wanted = footprint_radius_ + clearance;
  FreeLine line(from, along, limit, wanted, footprint_radius_ + std::min(hard_margin_, clearance));
  const Floats x = allOf(static_cast<float>(from.x));
  const Floats y = allOf(static_cast<float>(from.y));
  const Floats along_x = allOf(static_cast<float>(along.x));
  const Floats along_y = allOf(static_cast<float>(along.y));
  const auto lost = static_cast<float>(blur(from));
  const Floats wide = allOf(static_cast<float>(wanted) + lost);
  const float beyond = static_cast<float>(wanted) + 2.0f * lost;
  Floats far = allOf(static_cast<float>(limit) + beyond);
  const auto meet = [&](Floats middle_x, Floats middle_y, Floats half_x, Floats half_y) {
    const Floats dx = middle_x - x;
    const Floats dy = middle_y - y;
    const Floats ahead = along_x * dx + along_y * dy;
    const Floats aside = along_x * dy - along_y * dx;
    const Floats half_ahead = magnitude(along_x) * half_x + magnitude(along_y) * half_y;
    const Floats half_aside = magnitude(along_y) * half_x + magnitude(along_x) * half_y;
    return (magnitude(aside) - half_aside <= wide) & (ahead + half_ahead >= allOf(-lost)) & (ahead - half_ahead <= far);
  };
  visitGroups(meet, [&](const double* places) {
    line.meetGroup(places);
    far = allOf(static_cast<float>(line.free()) + beyond);
    return line.free() <= 0.0 || line.free() < enough;
  });
  return line.free();
}

double Shield::gap(const Point2& from) const {
  if (!footprint_.isCircle()) return arcGap({from.x, from.y, 0.0}, 0.0, 0.0);
  return nearest(from) - footprint_radius_;
}

double Shield::nearest(const Point2& from) const {
  constexpr double kWider = 4.0;
  const double most = reach_ + footprint_radius_;
  double nearest = most;
  // What is farther need not be looked at when something nearer is found.
  for (double half = std::min(most, 2.0 * footprint_radius_);; half = std::min(most, kWider * half)) {
    double squared = square(nearest);
    visitNear(from, half, [&](const Point2& obstacle) {
      squared = std::min(squared, square(obstacle.x - from.x) + square(obstacle.y - from.y));
      return false;
    });
    nearest = std::min(nearest, std::sqrt(squared));
    if (nearest <= half || half >= most) {
      return nearest;
    }
  }
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
    const double nearest =
        now <= hard ? now - kEdgeRounding : std::max(hard, std::min(clearance, now - kShieldTouchSlack));
    if (nearest > 0.0) free = std::min(free, sweep.freeBefore(local, nearest, free));
    return false;
  });
  return free;
}

double Shield::freeBack(const Pose2& from, double curvature, double limit, double clearance) const {
  return sweep(FootprintSweep::arc(footprint_, curvature, true), from, limit, clearance);
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
