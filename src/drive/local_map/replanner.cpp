#include "lstm_planner/drive/local_map/replanner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lstm_planner {

namespace {

/// Hysteresis: a new path is taken when it is this much better, a share, and m. Else every new wall seen would make the
/// robot turn back and forth between two paths of the same length.
constexpr double kWorthTurning = 0.08;
constexpr double kWorthTurningMetres = 0.3;

/// A route is costed by what is remembered as far as this, m.
constexpr double kLookedAt = 15.0;

constexpr int kClosedLooks = 3;     ///< looks around that must agree that there is no path
constexpr int kMostForgotten = 4;   ///< times that the memory may be wrong
constexpr double kForgiving = 1.0;  ///< m that the robot must come nearer to the goal until that is forgiven
/// Tolerances within which a goal is near.
constexpr double kNearGoalTolerances = 2.0;

constexpr double kBlockedAhead = 0.3;  ///< m at least to the place that is taken as blocked

/// Points of a route for which memory is reserved.
constexpr std::size_t kReserved = 256;

/// A point this near to the robot is behind it, m.
constexpr double kPassed = 0.25;

/// Corners are cut within this distance, m, where there is room all the way: a search pulls straight what is near, and
/// not in one piece.
constexpr double kPulled = 8.0;

/// It can be driven, and no other path that costs so much is worth turning for.
bool isHardlyCostlier(double cost, double other_cost) {
  return std::isfinite(cost) && cost <= other_cost * (1.0 + kWorthTurning) + kWorthTurningMetres;
}

/// How many of the first points of a route the robot has passed: up to the one beyond which the rest leads away from
/// it.
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

/// m to a place that leaves free where the robot stands.
double blockedAhead(const MemoryParameters& parameters, const ShieldParameters& shield) {
  return std::max(kBlockedAhead,
                  footprintOf(shield).inscribedRadius() + shield.tight_clearance + parameters.resolution);
}

}  // namespace

Replanner::Replanner(const MemoryParameters& parameters, const ShieldParameters& shield)
    : memory_(parameters, shield), finder_(parameters.tightness), blocked_ahead_(blockedAhead(parameters, shield)) {
  route_.points.reserve(kReserved);
  found_.points.reserve(kReserved);
}

void Replanner::start() {
  route_.points.clear();
  memory_.unblockAll();
  looking_ = false;
  closed_in_a_row_ = 0;
  relaxClearance(false);
  forgotten_ = 0;
  forgiven_at_.reset();
}

void Replanner::moveGoal(const Point2& from, const Point2& to) {
  if (!hasRoute() || distanceBetween(end(), from) != 0.0) return;
  route_.points.back() = to;
  route_.length = lengthOf(route_.points);
}

void Replanner::noteProgress(const Point2& here, const Point2& goal) {
  relaxClearance(false);
  // The goal may have moved since then.
  if (forgiven_at_ && distanceBetween(here, goal) > distanceBetween(*forgiven_at_, goal) - kForgiving) return;
  forgiven_at_ = here;
  forgotten_ = 0;
}

void Replanner::relaxClearance(bool relaxed) {
  clearance_is_relaxed_ = relaxed;
  memory_.relaxClearance(relaxed);
}

void Replanner::forget() {
  memory_.forget();
  route_.points.clear();
}

Replanner::Answer Replanner::update(const Situation& situation, const Point2& goal, double tolerance) {
  tolerance_ = tolerance;
  turn_.note(situation.pose.yaw, situation.time);
  memory_.add(situation);
  const Point2 here{situation.pose.x, situation.pose.y};
  if (hasRoute()) advanceRoute(here);
  // While it looks around, what lies behind the robot is not known and seems free.
  const bool still_looking = looking_ && !turn_.isOver();
  const bool found = !still_looking && finder_.find(memory_, here, goal, tolerance, &found_);
  // Cells are coarser than the route: what closes them need not close it.
  if (!found && (!hasRoute() || !std::isfinite(costOf(route_)))) return lookAround(situation);
  looking_ = false;
  closed_in_a_row_ = 0;
  shortest_ = found ? found_.length : route_.length;
  if (found && !isWorthKeeping()) std::swap(route_, found_);
  shortest_ = std::min(shortest_, route_.length);
  return Answer::kRoute;
}

double Replanner::regretOf(const Point2& here, const Point2& next, std::vector<Point2>* path_on) {
  path_on->clear();
  // Searches begin anywhere, also where the robot cannot be.
  if (!isPassable(next, next) || !finder_.findFrom(memory_, next, &found_)) {
    return std::numeric_limits<double>::infinity();
  }
  path_on->insert(path_on->end(), found_.points.begin() + 1, found_.points.end());
  // The route may be longer than the shortest path, as it is kept for a while: compared with it, going away is free.
  return std::max(0.0, distanceBetween(here, next) + found_.length - shortest_);
}

bool Replanner::isGoalBehindObstacle(const Point2& here, const Point2& goal, double near) const {
  return RouteFinder::isDetour(distanceBetween(here, goal), route_.length,
                               std::max(kNearGoalTolerances * tolerance_, near));
}

/// The robot is there now: what it has driven, and corners that it can cut, are left away.
void Replanner::advanceRoute(const Point2& here) {
  std::vector<Point2>& points = route_.points;
  std::size_t next = passed(memory_, here, points);
  while (next + 1 < points.size() && distanceBetween(here, points[next + 1]) < kPulled &&
         memory_.isFree(here, points[next + 1], LocalMap::Passage::kRoomy)) {
    ++next;
  }
  points.erase(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(next - 1));
  points.front() = here;
  route_.length = lengthOf(points);
}

/// Whether the route leads to where the one that was found does, and is hardly costlier.
bool Replanner::isWorthKeeping() const {
  constexpr double kSameEnd = 0.1;  // m
  return hasRoute() && distanceBetween(end(), found_.points.back()) < kSameEnd &&
         isHardlyCostlier(costOf(route_), costOf(found_));
}

/// With what is remembered now, m; +inf where it is blocked.
double Replanner::costOf(const Route& route) const {
  double cost = 0.0;
  double distance = 0.0;
  for (std::size_t i = 1; i < route.points.size(); ++i) {
    const Point2& from = route.points[i - 1];
    const Point2& to = route.points[i];
    const double length = distanceBetween(from, to);
    cost += distance < kLookedAt ? finder_.costOf(memory_, from, to) : length;
    distance += length;
  }
  return cost;
}

Replanner::Answer Replanner::lookAround(const Situation& situation) {
  route_.points.clear();
  if (looking_ && !turn_.isOver()) {
    return Answer::kLookAround;
  }
  if (looking_ && !clearance_is_relaxed_) {
    relaxClearance(true);
    return Answer::kLookAround;
  }
  if (looking_ && ++closed_in_a_row_ >= kClosedLooks) {
    return Answer::kNoPath;
  }
  if (!looking_ && ++forgotten_ > kMostForgotten) {
    return Answer::kLost;
  }
  looking_ = true;
  turn_.start(situation.pose.yaw, situation.time);
  memory_.forget();
  memory_.add(situation);
  return Answer::kLookAround;
}

std::optional<Point2> Replanner::blockAhead() {
  if (!hasRoute()) return std::nullopt;
  const Point2 place = pointAhead(blocked_ahead_);
  memory_.block(place);
  return place;
}

Point2 Replanner::blockTowards(const Point2& here, const Point2& next) {
  const Point2 place = pointAlong(here, directionTo(here, next), blocked_ahead_);
  memory_.block(place);
  return place;
}

Point2 Replanner::pointAhead(double distance) const {
  const std::vector<Point2>& points = route_.points;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double leg = distanceBetween(points[i - 1], points[i]);
    if (leg >= distance && leg > 0.0) {
      return pointAlong(points[i - 1], directionTo(points[i - 1], points[i]), distance);
    }
    distance -= leg;
  }
  return end();
}

double Replanner::bearingAhead(const Pose2& pose, double distance) const {
  return normalizeAngle(directionTo(pose, pointAhead(distance)) - pose.yaw);
}

void Replanner::pointsAhead(double distance, std::vector<Point2>* points) const {
  const std::vector<Point2>& all = route_.points;
  std::size_t i = 1;
  for (; i < all.size(); ++i) {
    distance -= distanceBetween(all[i - 1], all[i]);
    if (distance < 0.0) {
      break;
    }
  }
  points->clear();
  points->insert(points->end(), all.begin() + static_cast<std::ptrdiff_t>(std::min(i, all.size())), all.end());
}

}  // namespace lstm_planner
