#include "lstm_planner/drive/collision/shield.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

#include "drive/collision/shield_groups.hpp"

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

}  // namespace lstm_planner
