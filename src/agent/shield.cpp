#include "lstm_planner/agent/shield.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace lstm_planner {

namespace {
/// A return must come this much nearer before it counts as coming nearer: less than the noise of any scanner.
constexpr double kTouchSlack = 1e-3;
}  // namespace

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

double Shield::gap(const Point2& from) const {
  double nearest = reach_ + footprint_radius_;
  for (const Point2& obstacle : obstacles_) {
    nearest = std::min(nearest, distanceBetween(from, obstacle));
  }
  return nearest - footprint_radius_;
}

}  // namespace lstm_planner
