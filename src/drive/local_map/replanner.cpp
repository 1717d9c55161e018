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

constexpr int kClosedLooks = 3;    ///< looks around that must agree that there is no path
constexpr int kMostForgotten = 4;  ///< without progress in between
/// Tolerances within which a goal is near.
constexpr double kNearGoalTolerances = 2.0;

constexpr double kBlockedAhead = 0.3;  ///< m to the place that is taken as blocked

/// It can be driven, and no other path that costs so much is worth turning for.
bool isHardlyCostlier(double cost, double other_cost) {
  return std::isfinite(cost) && cost <= other_cost * (1.0 + kWorthTurning) + kWorthTurningMetres;
}

}  // namespace

Replanner::Replanner(const MemoryParameters& parameters, const ShieldParameters& shield)
    : memory_(parameters, shield),
      finder_(parameters.tightness),
      bounds_(parameters, shield),
      route_(parameters, shield),
      candidate_(parameters, shield),
      reach_of_changes_(KeptRoute::reachOfChanges(parameters, shield)) {
  found_.points.reserve(route().points.capacity());
}

void Replanner::start() {
  route_.clear();
  has_costs_ = false;
  looking_ = false;
  closed_in_a_row_ = 0;
  noteProgress();
}

void Replanner::moveGoal(const Point2& from, const Point2& to) {
  if (!route_.isEmpty() && distanceBetween(end(), from) == 0.0) {
    route_.moveEnd(to);
  }
}

void Replanner::noteProgress() {
  forgotten_ = 0;
  clearance_is_relaxed_ = false;
  memory_.relaxClearance(false);
}

void Replanner::forget() {
  memory_.forget();
  route_.clear();
}

Replanner::Answer Replanner::update(const Situation& situation, const Point2& goal, double tolerance) {
  tolerance_ = tolerance;
  turn_.note(situation.pose.yaw, situation.time);
  memory_.add(situation);
  const Point2 here{situation.pose.x, situation.pose.y};
  bool found = false;
  if (!looking_ && costsHold(here, goal)) {
    const double cost = route_.cost(memory_, finder_, kLookedAt);
    bounds_.takeInChanges(&memory_, finder_.costToGo(), here, goal,
                          (cost - kWorthTurningMetres) / (1.0 + kWorthTurning));
    if (isWorthKeeping(here, goal, cost)) {
      closed_in_a_row_ = 0;
      return Answer::kRoute;
    }
    found = takeFromLastSearch(here, goal);
  }
  // While it looks around, what lies behind the robot is not known and seems free.
  const bool still_looking = looking_ && !turn_.isOver();
  found = found || (!still_looking && findRoute(here, goal, &found_));
  memory_.clearChanges();
  if (!found) {
    return lookAround(situation);
  }
  looking_ = false;
  closed_in_a_row_ = 0;
  takeBetter(here);
  return Answer::kRoute;
}

double Replanner::regretOf(const Point2& here, const Point2& next, const Point2& goal, std::vector<Point2>* path_on) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const auto lengthFrom = [&](const Point2& place) {
    const bool is_known = has_costs_ && takeFromLastSearch(place, goal);
    return is_known || findRoute(place, goal, &found_) ? found_.length : kNone;
  };
  path_on->clear();
  // Searches begin anywhere, also where the robot cannot be.
  if (!isPassable(next, next)) return kNone;
  // The route may be longer than the shortest path, as it is kept for a while: compared with it, going away is free.
  const double from_here = std::min(route().length, lengthFrom(here));
  const double from_next = lengthFrom(next);
  if (from_next < kNone) path_on->insert(path_on->end(), found_.points.begin() + 1, found_.points.end());
  return std::max(0.0, distanceBetween(here, next) + from_next - from_here);
}

bool Replanner::isGoalBehindObstacle(const Point2& here, const Point2& goal, double near) const {
  return RouteFinder::isDetour(distanceBetween(here, goal), route().length,
                               std::max(kNearGoalTolerances * tolerance_, near));
}

bool Replanner::findRoute(const Point2& start, const Point2& goal, Route* route) {
  ++searches_;
  const bool found = finder_.find(memory_, start, goal, tolerance_, route);
  has_costs_ = found && finder_.endsAtGoal();
  bounds_.noteSearch(memory_, start, goal);
  return found;
}

bool Replanner::takeBetter(const Point2& here) {
  candidate_.swap(&found_);
  const double new_cost = candidate_.cost(memory_, finder_, kLookedAt);
  bounds_.noteRoute(memory_, finder_.costToGo(), here, new_cost);
  const bool same_end =
      !route_.isEmpty() && distanceBetween(route_.route().points.back(), candidate_.route().points.back()) < 0.1;
  if (same_end && isHardlyCostlier(route_.cost(memory_, finder_, kLookedAt), new_cost)) {
    return false;
  }
  route_.swap(&candidate_);
  return true;
}

/// Brings the route up to date; false when the costs of the last search tell nothing any more.
bool Replanner::costsHold(const Point2& here, const Point2& goal) {
  if (route_.isEmpty()) {
    return false;
  }
  route_.advance(memory_, here);
  if (memory_.everythingChanged()) {
    has_costs_ = false;
    route_.noteAll();
  }
  for (const LocalMap::Change& change : memory_.changes()) {
    route_.note(memory_, change);
  }
  return has_costs_ && goalIsAsBefore(goal) &&
         !RouteFinder::isDetour(distanceBetween(here, goal), route_.route().length, tolerance_);
}

bool Replanner::isWorthKeeping(const Point2& here, const Point2& goal, double cost) const {
  return isHardlyCostlier(cost, distanceBetween(here, end())) ||
         isHardlyCostlier(cost, bounds_.leastCost(memory_, finder_.costToGo(), here, goal));
}

/// By the last search alone; false when it takes a new one.
bool Replanner::takeFromLastSearch(const Point2& here, const Point2& goal) {
  if (memory_.cellAt(goal) != memory_.cellAt(bounds_.searchedGoal()) ||
      !finder_.fromLastSearch(memory_, here, &found_)) {
    return false;
  }
  found_.points.back() = end();
  found_.length = lengthOf(found_.points);
  return isHardlyCostlier(found_.cost, bounds_.throughFreed(memory_)) &&
         !RouteFinder::isDetour(distanceBetween(here, goal), found_.length, tolerance_);
}

/// False when a search might end elsewhere.
bool Replanner::goalIsAsBefore(const Point2& goal) {
  const bool at_goal = distanceBetween(end(), goal) == 0.0;
  const Point2& searched_goal = bounds_.searchedGoal();
  const double moved = distanceBetween(goal, searched_goal);
  const double reach = reach_of_changes_ + (at_goal ? 0.0 : tolerance_ + memory_.cellSize());
  const bool changed = moved > 0.0 || std::any_of(memory_.changes().begin(), memory_.changes().end(),
                                                  [&](const LocalMap::Change& change) {
                                                    const double x = change.place.x - goal.x;
                                                    const double y = change.place.y - goal.y;
                                                    return x * x + y * y < reach * reach;
                                                  });
  if (!changed) {
    return true;
  }
  if (!at_goal || (memory_.cellAt(goal) < 0) != (memory_.cellAt(searched_goal) < 0)) {
    return false;
  }
  return memory_.cellAt(goal) < 0 || memory_.isFree(searched_goal, goal, LocalMap::Passage::kTight);
}

Replanner::Answer Replanner::lookAround(const Situation& situation) {
  route_.clear();
  if (looking_ && !turn_.isOver()) {
    return Answer::kLookAround;
  }
  if (looking_ && !clearance_is_relaxed_) {
    clearance_is_relaxed_ = true;
    memory_.relaxClearance(true);
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

void Replanner::blockAhead() {
  if (!route_.isEmpty()) {
    memory_.block(pointAhead(kBlockedAhead));
  }
}

void Replanner::blockTowards(const Point2& here, const Point2& next) {
  memory_.block(pointAlong(here, directionTo(here, next), kBlockedAhead));
}

Point2 Replanner::pointAhead(double distance) const {
  const std::vector<Point2>& points = route().points;
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
  const std::vector<Point2>& all = route().points;
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
