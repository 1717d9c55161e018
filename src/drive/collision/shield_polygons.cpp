#include <algorithm>
#include <cmath>

#include "drive/collision/footprint_sweep.hpp"
#include "drive/collision/shield_groups.hpp"
#include "lstm_planner/drive/collision/shield.hpp"

namespace lstm_planner {

namespace {

constexpr double kEdgeRounding = 1e-6;  // m

}  // namespace

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

}  // namespace lstm_planner
