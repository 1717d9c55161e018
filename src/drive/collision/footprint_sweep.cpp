#include "drive/collision/footprint_sweep.hpp"

#include <algorithm>
#include <cmath>

#include "lstm_planner/common/segment.hpp"

namespace lstm_planner {

namespace {

/// Below this, 1/m, an arc of the lengths that matter here is a straight line to a tenth of a millimetre.
constexpr double kStraight = 1e-5;

Footprint mirror(const Footprint& footprint, bool side, bool front) {
  std::vector<Point2> corners = footprint.corners();
  for (Point2& corner : corners) corner = {front ? -corner.x : corner.x, side ? -corner.y : corner.y};
  return Footprint(corners);
}

/// Of a whole turn, in [0, 2 pi).
double fullTurn(double angle) {
  const double wrapped = std::fmod(angle, 2.0 * M_PI);
  return wrapped < 0.0 ? wrapped + 2.0 * M_PI : wrapped;
}

}  // namespace

FootprintSweep::FootprintSweep(const Footprint& footprint, double radius, bool mirror_side, bool mirror_front,
                               bool turns)
    : footprint_(mirror(footprint, mirror_side, mirror_front)),
      radius_(radius),
      mirror_side_(mirror_side),
      mirror_front_(mirror_front),
      turns_(turns) {}

FootprintSweep FootprintSweep::arc(const Footprint& footprint, double curvature, bool back) {
  if (std::abs(curvature) < kStraight) return straight(footprint, back);
  return {footprint, 1.0 / std::abs(curvature), curvature < 0.0, back, false};
}

double FootprintSweep::freeBefore(const Point2& point, double distance, double limit) const {
  const Point2 local = mirrored(point);
  return isStraight() ? freeStraight(local, distance, limit) : freeTurn(local, distance, limit);
}

double FootprintSweep::freeStraight(const Point2& point, double distance, double limit) const {
  const std::vector<Point2>& corners = footprint_.corners();
  double front = -INFINITY;  // of the grown polygon beside the point
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2& from = corners[i];
    const Point2& to = corners[(i + 1) % corners.size()];
    const double aside = std::abs(point.y - from.y);
    if (aside <= distance) front = std::max(front, from.x + std::sqrt(square(distance) - square(aside)));
    if (to.y <= from.y) continue;  // counter-clockwise: sides that lead up are in front
    const double length = distanceBetween(from, to);
    const Point2 out{distance * (to.y - from.y) / length, distance * (from.x - to.x) / length};
    const double share = (point.y - from.y - out.y) / (to.y - from.y);
    if (share >= 0.0 && share <= 1.0) front = std::max(front, from.x + out.x + share * (to.x - from.x));
  }
  return point.x < front ? limit : std::min(limit, point.x - front);
}

double FootprintSweep::angleOf(const Point2& place) const { return std::atan2(place.x, radius_ - place.y); }

Point2 FootprintSweep::placeAt(double angle, double around) const {
  return {around * std::sin(angle), radius_ - around * std::cos(angle)};
}

template <typename Note>
void FootprintSweep::meet(const Point2& point, double distance, const Note& note) const {
  const std::vector<Point2>& corners = footprint_.corners();
  const double around = std::hypot(point.x, radius_ - point.y);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2& from = corners[i];
    const Point2& to = corners[(i + 1) % corners.size()];
    // The corner's circle, by the chord from the place in the corner's direction, which loses no digits on wide arcs.
    const double corner_around = std::hypot(from.x, radius_ - from.y);
    const double chord = square(distance) - square(around - corner_around);
    if (chord >= 0.0 && around > 0.0 && corner_around > 0.0) {
      const double half = 0.5 * std::sqrt(chord / (around * corner_around));
      const double aside = 2.0 * std::asin(std::min(1.0, half));
      const double middle = angleOf(from);
      note(middle - aside);
      note(middle + aside);
    }
    // The side, moved out.
    const double length = distanceBetween(from, to);
    const Point2 along{(to.x - from.x) / length, (to.y - from.y) / length};
    const Point2 start{from.x + distance * along.y, from.y - distance * along.x};
    const double b = start.x * along.x + (start.y - radius_) * along.y;
    const double start_around = std::hypot(start.x, radius_ - start.y);
    const double c = (start_around - around) * (start_around + around);
    const double root = square(b) - c;
    if (root < 0.0) continue;
    const double far = -b - std::copysign(std::sqrt(root), b);
    for (const double at : {far, far != 0.0 ? c / far : 0.0}) {
      if (at >= 0.0 && at <= length) note(angleOf({start.x + at * along.x, start.y + at * along.y}));
    }
  }
}

double FootprintSweep::freeTurn(const Point2& point, double distance, double limit) const {
  const double now = angleOf(point);
  double free = limit;
  meet(point, distance, [&](double angle) { free = std::min(free, lengthOf(fullTurn(now - angle))); });
  return free;
}

double FootprintSweep::leastDistance(const Point2& point, double length) const {
  const Point2 local = mirrored(point);
  const std::vector<Point2>& corners = footprint_.corners();
  const double now = footprint_.distanceTo(local);
  if (now <= 0.0 || freeBefore(point, 0.0, length) < length) return 0.0;
  double least = now;
  if (isStraight()) {
    // A convex polygon and a straight path: nearest at one of the ends, or where a corner of either faces the other.
    const Point2 end{local.x - length, local.y};
    least = std::min(least, footprint_.distanceTo(end));
    for (const Point2& corner : corners)
      least = std::min(least, std::sqrt(squaredDistanceToSegment(corner, local, end)));
    return least;
  }
  const double whole = turns_ ? length : length / radius_;
  const double first = angleOf(local);
  const double around = std::hypot(local.x, radius_ - local.y);
  const auto isPassed = [&](double angle) { return fullTurn(first - angle) <= whole; };
  least = std::min(least, footprint_.distanceTo(placeAt(first - whole, around)));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2& from = corners[i];
    const Point2& to = corners[(i + 1) % corners.size()];
    for (const double angle : {angleOf(from), directionTo(from, to), directionTo(from, to) + M_PI}) {
      if (isPassed(angle)) least = std::min(least, footprint_.distanceTo(placeAt(angle, around)));
    }
  }
  return least;
}

bool FootprintSweep::comesNearer(const Point2& point) const {
  const Point2 local = mirrored(point);
  constexpr double kShort = 1e-4;     // m
  constexpr double kRounding = 1e-9;  // m
  const double angle = kShort / (radius_ + footprint_.circumscribedRadius());
  const Point2 later = isStraight() ? Point2{local.x - kShort, local.y}
                                    : placeAt(angleOf(local) - angle, std::hypot(local.x, radius_ - local.y));
  return footprint_.distanceTo(later) < footprint_.distanceTo(local) - kRounding;
}

}  // namespace lstm_planner
