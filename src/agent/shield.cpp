#include "lstm_planner/agent/shield.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

#include "perception/lanes.hpp"

namespace lstm_planner {

namespace {

/// A return must come this much nearer before it counts as coming nearer: less than the noise of any scanner.
constexpr double kTouchSlack = 1e-3;

/// Below this, 1/m, an arc of the lengths that matter here is a straight line to a millionth of a millimetre.
constexpr double kStraight = 1e-9;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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
  const std::size_t most = obstacles.size() / kGroup + 1;
  groups_ = 0;
  if (x_.size() < most * kGroup) {
    x_.resize(most * kGroup);
    y_.resize(most * kGroup);
    for (std::vector<float>* box : {&middle_x_, &middle_y_, &half_x_, &half_y_}) box->resize(most + kLanes);
  }
  std::size_t first = 0;
  for (; first + kGroup <= obstacles.size(); first += kGroup) {
    showGroup(&obstacles[first], false);
  }
  if (first < obstacles.size()) {
    showNear(&obstacles[first], obstacles.size() - first);
  }
}

void Shield::showGroup(const Point2* obstacles, bool all_near) {
  double* const x = &x_[groups_ * kGroup];
  double* const y = &y_[groups_ * kGroup];
  Doubles left = allOf(kInfinity);
  Doubles right = allOf(-kInfinity);
  Doubles bottom = left;
  Doubles top = right;
  for (std::size_t i = 0; i < kGroup; i += 2) {
    const Doubles first = loadDoubles(&obstacles[i].x);
    const Doubles second = loadDoubles(&obstacles[i + 1].x);
    const Doubles xs{first[0], second[0]};
    const Doubles ys{first[1], second[1]};
    store(xs, x + i);
    store(ys, y + i);
    left = lesser(xs, left);
    right = greater(xs, right);
    bottom = lesser(ys, bottom);
    top = greater(ys, top);
  }
  const Point2 low{std::min(left[0], left[1]), std::min(bottom[0], bottom[1])};
  const Point2 high{std::max(right[0], right[1]), std::max(top[0], top[1])};
  if (!all_near) {
    const double nearest = square(std::max({0.0, low.x, -high.x})) + square(std::max({0.0, low.y, -high.y}));
    const double farthest = square(std::max(-low.x, high.x)) + square(std::max(-low.y, high.y));
    if (nearest > square(reach_)) {
      return;
    }
    if (!(farthest <= square(reach_))) {
      return showNear(obstacles, kGroup);
    }
  }
  middle_x_[groups_] = static_cast<float>(0.5 * (low.x + high.x));
  middle_y_[groups_] = static_cast<float>(0.5 * (low.y + high.y));
  half_x_[groups_] = static_cast<float>(0.5 * (high.x - low.x));
  half_y_[groups_] = static_cast<float>(0.5 * (high.y - low.y));
  ++groups_;
}

void Shield::showNear(const Point2* obstacles, std::size_t count) {
  Point2 near[kGroup];
  const auto isNear = [&](const Point2& place) { return square(place.x) + square(place.y) <= square(reach_); };
  Point2* const end = std::copy_if(obstacles, obstacles + count, near, isNear);
  if (end != near) {
    std::fill(end, near + kGroup, near[0]);
    showGroup(near, true);
  }
}

double Shield::blur(const Point2& from) const { return 1e-6 * (1.0 + reach_ + std::abs(from.x) + std::abs(from.y)); }

template <typename Meet, typename Look>
void Shield::lookIntoGroups(const Meet& meet, const Look& look) const {
  for (std::size_t first = 0; first < groups_; first += kLanes) {
    const Ints met = meet(loadFloats(&middle_x_[first]), loadFloats(&middle_y_[first]), loadFloats(&half_x_[first]),
                          loadFloats(&half_y_[first]));
    if (!any(met)) {
      continue;
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (met[lane] != 0 && first + lane < groups_ && look((first + lane) * kGroup)) {
        return;
      }
    }
  }
}

template <typename Look>
void Shield::lookAround(const Point2& from, double distance, const Look& look) const {
  const Floats x = allOf(static_cast<float>(from.x));
  const Floats y = allOf(static_cast<float>(from.y));
  const Floats wide = allOf(static_cast<float>(distance + blur(from)));
  const auto meet = [&](Floats middle_x, Floats middle_y, Floats half_x, Floats half_y) {
    return (magnitude(middle_x - x) <= half_x + wide) & (magnitude(middle_y - y) <= half_y + wide);
  };
  lookIntoGroups(meet, [&](std::size_t group) {
    for (std::size_t i = group; i < group + kGroup; ++i) {
      if (look(Point2{x_[i], y_[i]})) {
        return true;
      }
    }
    return false;
  });
}

double Shield::freeDistance(const Point2& from, double direction, double limit, double clearance) const {
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  const double wanted = footprint_radius_ + clearance;
  const double hard = footprint_radius_ + std::min(hard_margin_, clearance);
  double free = limit;
  const auto shorten = [&](double along, double aside) {
    const double squared = square(along) + square(aside);
    double radius = wanted;
    if (squared < square(wanted + kTouchSlack)) {
      const double now = std::sqrt(squared);
      if (now <= hard) {
        free = 0.0;
        return;
      }
      radius = std::max(hard, std::min(wanted, now - kTouchSlack));
    }
    if (aside < radius) {
      free = std::min(free, std::max(0.0, along - std::sqrt(square(radius) - square(aside))));
    }
  };
  const Floats x = allOf(static_cast<float>(from.x));
  const Floats y = allOf(static_cast<float>(from.y));
  const Floats along_x = allOf(static_cast<float>(c));
  const Floats along_y = allOf(static_cast<float>(s));
  const auto small = static_cast<float>(blur(from));
  const Floats wide = allOf(static_cast<float>(wanted) + small);
  const Floats far = allOf(static_cast<float>(limit + wanted + blur(from)));
  const auto meet = [&](Floats middle_x, Floats middle_y, Floats half_x, Floats half_y) {
    const Floats dx = middle_x - x;
    const Floats dy = middle_y - y;
    const Floats along = along_x * dx + along_y * dy;
    const Floats aside = along_x * dy - along_y * dx;
    const Floats half_along = magnitude(along_x) * half_x + magnitude(along_y) * half_y;
    const Floats half_aside = magnitude(along_y) * half_x + magnitude(along_x) * half_y;
    return (magnitude(aside) - half_aside <= wide) & (along + half_along >= allOf(-small)) & (along - half_along <= far);
  };
  lookIntoGroups(meet, [&](std::size_t group) {
    for (std::size_t i = group; i < group + kGroup; i += 2) {
      const Doubles dx = loadDoubles(&x_[i]) - allOf(from.x);
      const Doubles dy = loadDoubles(&y_[i]) - allOf(from.y);
      const Doubles along = allOf(c) * dx + allOf(s) * dy;
      const Doubles aside = magnitude(allOf(c) * dy - allOf(s) * dx);
      // What the footprint does not reach before or at the end of what is free so far.
      const Doubles beyond = greater(along - allOf(free), Doubles{});
      const auto matters = (along > Doubles{}) & (beyond * beyond + aside * aside < allOf(square(wanted)));
      if (any(matters)) {
        if (matters[0] != 0) shorten(along[0], aside[0]);
        if (matters[1] != 0) shorten(along[1], aside[1]);
      }
    }
    return free <= 0.0;
  });
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
  lookAround({from.x, from.y}, wanted + limit, [&](const Point2& obstacle) {
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
    const double radius = now <= hard ? now : std::max(hard, std::min(wanted, now - kTouchSlack));
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

double Shield::gap(const Point2& from) const { return nearest(from) - footprint_radius_; }

double Shield::nearest(const Point2& from) const {
  constexpr double kWider = 4.0;
  const double most = reach_ + footprint_radius_;
  double nearest = most;
  // What is farther need not be looked at when something nearer is found.
  for (double half = std::min(most, 2.0 * footprint_radius_);; half = std::min(most, kWider * half)) {
    double squared = square(nearest);
    lookAround(from, half, [&](const Point2& obstacle) {
      squared = std::min(squared, square(obstacle.x - from.x) + square(obstacle.y - from.y));
      return false;
    });
    nearest = std::min(nearest, std::sqrt(squared));
    if (nearest <= half || half >= most) {
      return nearest;
    }
  }
}

double Shield::arcGap(const Pose2& from, double curvature, double length) const {
  const Pose2 end = alongArc(from, curvature, length);
  const bool straight = std::abs(curvature) < kStraight;
  const Arc arc(straight ? 1.0 : curvature);
  const Point2 start{from.x, from.y};
  double nearest_so_far = nearest(start);
  lookAround(start, length + nearest_so_far, [&](const Point2& obstacle) {
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
