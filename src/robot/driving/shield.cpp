#include "lstm_planner/robot/driving/shield.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

#include "robot/driving/shield_groups.hpp"
#include "robot/driving/shield_kernels.hpp"

namespace lstm_planner {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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
  return shieldKernels().add(&obstacles->x, groups, reach_squared, places_.data(), boxes_.data(), &groups_);
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
  DiscLine line;
  line.from_x = from.x;
  line.from_y = from.y;
  line.along_x = std::cos(direction);
  line.along_y = std::sin(direction);
  line.limit = limit;
  line.wanted = footprint_radius_ + clearance;
  line.hard = footprint_radius_ + std::min(hard_margin_, clearance);
  line.enough = enough;
  line.blur = blur(from);
  return shieldKernels().freeLine({groups_, places_.data(), boxes_.data()}, line);
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
