#include "lstm_planner/agent/route_guide.hpp"

#include <algorithm>
#include <cmath>

namespace lstm_planner {

namespace {

/// A new way is taken when it is this much better: a share, and m. Else every new wall seen would make the robot turn
/// back and forth between two ways of the same length.
constexpr double kWorthTurning = 0.08;
constexpr double kWorthTurningMetres = 0.3;

constexpr double kFullTurn = 2.0 * M_PI - 0.5;  ///< rad; the scanner sees more than the rest at once
constexpr int kClosedLooks = 3;                 ///< looks around that must agree that there is no way
constexpr int kMostForgotten = 4;               ///< without progress in between
constexpr double kBlockedAhead = 0.3;           ///< m to the place that is taken as blocked

}  // namespace

RouteGuide::RouteGuide(const AgentParameters& parameters)
    : parameters_(parameters), memory_(parameters.memory, parameters.shield), finder_(parameters.memory.tightness) {}

void RouteGuide::begin(const Point2& goal) {
  goal_ = goal;
  route_.points.clear();
  driven_ = 0.0;
  looking_ = false;
  closed_in_a_row_ = 0;
  noteProgress();
}

void RouteGuide::moveGoal(const Point2& goal) {
  if (!route_.points.empty() && distanceBetween(end(), goal_) == 0.0) {
    route_.points.back() = goal;
    route_.length = lengthOf(route_.points);
  }
  goal_ = goal;
}

void RouteGuide::noteProgress() {
  forgotten_ = 0;
  squeezing_ = false;
  memory_.squeeze(false);
}

void RouteGuide::forget() {
  memory_.forget();
  route_.points.clear();
  has_pose_ = false;
}

RouteGuide::Status RouteGuide::update(const Situation& situation) {
  if (has_pose_) {
    driven_ += distanceBetween(last_pose_, situation.pose);
    turned_ += std::abs(normalizeAngle(situation.pose.yaw - last_pose_.yaw));
  }
  last_pose_ = situation.pose;
  has_pose_ = true;
  memory_.look(situation);
  const Point2 here{situation.pose.x, situation.pose.y};
  // While it looks around, what lies behind the robot is not known and seems free.
  const bool still_looking = looking_ && turned_ < kFullTurn;
  if (still_looking || !finder_.find(memory_, here, goal_, tolerance(), &candidate_)) {
    return lookAround(situation);
  }
  looking_ = false;
  closed_in_a_row_ = 0;
  if (!keepRoute(situation)) {
    std::swap(route_, candidate_);
  }
  return Status::kRoute;
}

double RouteGuide::tolerance() const {
  return parameters_.goal_tolerance + parameters_.goal_drift * driven_;
}

bool RouteGuide::keepRoute(const Situation& situation) {
  if (route_.points.size() < 2) {
    return false;
  }
  // The part that was driven: up to the point beyond which the rest leads away from the robot.
  std::size_t next = 1;
  while (next + 1 < route_.points.size()) {
    const double here = distanceBetween(situation.pose, route_.points[next]);
    const double leg = distanceBetween(route_.points[next], route_.points[next + 1]);
    const double beyond = distanceBetween(situation.pose, route_.points[next + 1]);
    if (here > 0.25 && beyond * beyond > leg * leg + here * here) {
      break;
    }
    if (here > 0.25 && !memory_.isFree({situation.pose.x, situation.pose.y}, route_.points[next + 1],
                                       ObstacleMemory::Passage::kTight)) {
      break;
    }
    ++next;
  }
  route_.points.erase(route_.points.begin(), route_.points.begin() + static_cast<std::ptrdiff_t>(next - 1));
  route_.points.front() = {situation.pose.x, situation.pose.y};
  constexpr double kLookedAt = 15.0;
  const double old_cost = finder_.costOf(memory_, route_, kLookedAt);
  const double new_cost = finder_.costOf(memory_, candidate_, kLookedAt);
  const bool same_end = distanceBetween(route_.points.back(), candidate_.points.back()) < 0.1;
  if (!same_end || !(old_cost <= new_cost * (1.0 + kWorthTurning) + kWorthTurningMetres)) {
    return false;
  }
  route_.length = lengthOf(route_.points);
  return true;
}

RouteGuide::Status RouteGuide::lookAround(const Situation& situation) {
  route_.points.clear();
  if (looking_ && turned_ < kFullTurn) {
    return Status::kLookAround;
  }
  if (looking_ && !squeezing_) {
    squeezing_ = true;
    memory_.squeeze(true);
    return Status::kLookAround;
  }
  if (looking_ && ++closed_in_a_row_ >= kClosedLooks) {
    return Status::kClosed;
  }
  if (!looking_ && ++forgotten_ > kMostForgotten) {
    return Status::kLost;
  }
  looking_ = true;
  turned_ = 0.0;
  memory_.forget();
  memory_.look(situation);
  return Status::kLookAround;
}

void RouteGuide::blockAhead() {
  if (route_.points.size() >= 2) {
    memory_.block(pointAhead(kBlockedAhead));
  }
}

Point2 RouteGuide::pointAhead(double distance) const {
  for (std::size_t i = 1; i < route_.points.size(); ++i) {
    const double leg = distanceBetween(route_.points[i - 1], route_.points[i]);
    if (leg >= distance && leg > 0.0) {
      return pointAlong(route_.points[i - 1], directionTo(route_.points[i - 1], route_.points[i]), distance);
    }
    distance -= leg;
  }
  return end();
}

double RouteGuide::bearingAhead(const Pose2& pose, double distance) const {
  return normalizeAngle(directionTo(pose, pointAhead(distance)) - pose.yaw);
}

void RouteGuide::pointsAhead(double distance, std::vector<Point2>* points) const {
  points->clear();
  for (std::size_t i = 1; i < route_.points.size(); ++i) {
    distance -= distanceBetween(route_.points[i - 1], route_.points[i]);
    if (distance < 0.0) {
      points->push_back(route_.points[i]);
    }
  }
}

bool RouteGuide::findFrom(const Point2& start, Route* route) {
  return finder_.find(memory_, start, goal_, tolerance(), route);
}

}  // namespace lstm_planner
