#include "lstm_planner/drive/local_map/kept_route.hpp"

#include <utility>
#include <vector>

namespace lstm_planner {

namespace {

/// Points of a route for which memory is reserved.
constexpr std::size_t kReserved = 256;

/// A point this near to the robot is behind it, m.
constexpr double kPassed = 0.25;

/// Corners are cut within this distance, m, where there is room all the way: a search pulls straight what is near, and
/// not in one piece.
constexpr double kPulled = 8.0;

/// How many of the first points the robot has passed: up to the one beyond which the rest leads away from it.
std::size_t passed(const LocalMap& memory, const Point2& here, const std::vector<Point2>& points) {
  std::size_t next = 1;
  for (; next + 1 < points.size(); ++next) {
    const double to_next = distanceBetween(here, points[next]);
    if (to_next <= kPassed) continue;
    const double piece = distanceBetween(points[next], points[next + 1]);
    const double beyond = distanceBetween(here, points[next + 1]);
    if (beyond * beyond > piece * piece + to_next * to_next) break;
    if (!memory.isFree(here, points[next + 1], LocalMap::Passage::kTight)) break;
  }
  return next;
}

}  // namespace

KeptRoute::KeptRoute() { route_.points.reserve(kReserved); }

void KeptRoute::swap(Route* route) { std::swap(route_, *route); }

void KeptRoute::moveEnd(const Point2& end) {
  route_.points.back() = end;
  route_.length = lengthOf(route_.points);
}

void KeptRoute::advance(const LocalMap& memory, const Point2& here) {
  std::vector<Point2>& points = route_.points;
  std::size_t next = passed(memory, here, points);
  while (next + 1 < points.size() && distanceBetween(here, points[next + 1]) < kPulled &&
         memory.isFree(here, points[next + 1], LocalMap::Passage::kRoomy)) {
    ++next;
  }
  points.erase(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(next - 1));
  points.front() = here;
  route_.length = lengthOf(points);
}

}  // namespace lstm_planner
