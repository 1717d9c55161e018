#include "lstm_planner/robot/driving/shield.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

#include "robot/driving/shield_groups.hpp"

namespace lstm_planner {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double square(double value) { return value * value; }

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
  const std::size_t most = groups_ + (obstacles.size() + kGroup - 1) / kGroup;
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
    left = minimum(xs, left);
    right = maximum(xs, right);
    bottom = minimum(ys, bottom);
    top = maximum(ys, top);
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

double Shield::freeLine(const Point2& from, double direction, double limit, double clearance, double enough) const {
  if (!footprint_.isCircle()) return freeArc({from.x, from.y, direction}, 0.0, limit, clearance);
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  const double wanted = footprint_radius_ + clearance;
  const double hard = footprint_radius_ + std::min(hard_margin_, clearance);
  double free = limit;
  const auto shorten = [&](double along, double aside) {
    const double squared = square(along) + square(aside);
    double radius = wanted;
    if (squared < square(wanted + kShieldTouchSlack)) {
      const double now = std::sqrt(squared);
      if (now <= hard) {
        free = 0.0;
        return;
      }
      radius = std::max(hard, std::min(wanted, now - kShieldTouchSlack));
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
    return (magnitude(aside) - half_aside <= wide) & (along + half_along >= allOf(-small)) &
           (along - half_along <= far);
  };
  visitGroups(meet, [&](std::size_t group) {
    for (std::size_t i = group; i < group + kGroup; i += 2) {
      const Doubles dx = loadDoubles(&x_[i]) - allOf(from.x);
      const Doubles dy = loadDoubles(&y_[i]) - allOf(from.y);
      const Doubles along = allOf(c) * dx + allOf(s) * dy;
      const Doubles aside = magnitude(allOf(c) * dy - allOf(s) * dx);
      // What the footprint does not reach before or at the end of what is free so far.
      const Doubles beyond = maximum(along - allOf(free), Doubles{});
      const auto matters = (along > Doubles{}) & (beyond * beyond + aside * aside < allOf(square(wanted)));
      if (any(matters)) {
        if (matters[0] != 0) shorten(along[0], aside[0]);
        if (matters[1] != 0) shorten(along[1], aside[1]);
      }
    }
    return free <= 0.0 || free < enough;
  });
  return free;
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

}  // namespace lstm_planner
