#include <algorithm>
#include <cmath>

#include "lstm_planner/agent/navigation_agent.hpp"

namespace lstm_planner {

namespace {

/// Directions beside the route that are tried when its first metres are not free: steps and farthest, rad.
constexpr double kAsideStep = 0.0873;
constexpr double kFarthestAside = 1.05;

/// A steering angle that is no farther than this from the route's bearing agrees with it, rad (45 degrees and a bit).
constexpr double kAgreement = 0.8;

/// A way that comes this near to where it began has turned back, m.
constexpr double kTurnedBack = 0.1;

bool comesBackTo(const Point2& start, const std::vector<Point2>& way) {
  for (std::size_t i = 1; i < way.size(); ++i) {
    if (squaredDistanceToPiece(start, way[i - 1], way[i]) < kTurnedBack * kTurnedBack) {
      return true;
    }
  }
  return false;
}

}  // namespace

void NavigationAgent::choose(const Situation& situation) {
  const EscapeParameters& escape = parameters_.escape;
  const auto patience = [&](double times) {
    return steps_since_best_ >= times * escape.patience_steps || driven_since_best_ >= times * escape.patience_distance;
  };
  if (escape.enabled && leader_ == Leader::kNetwork && patience(1.0)) {
    lead(parameters_.memory.enabled ? Leader::kRoute : Leader::kBoundary);
  }
  const bool lost = parameters_.memory.enabled && guide_status_ == RouteGuide::Status::kLost;
  if (escape.enabled && leader_ != Leader::kBoundary && (lost || patience(escape.last_resort))) {
    lead(Leader::kBoundary);
  }
  decision_.on_route = false;
  if (!chooseGoalInSight(situation)) {
    if (leader_ == Leader::kBoundary) {
      chooseEscape(situation);
    } else if (leader_ == Leader::kRoute || network_knows_route_) {
      chooseRoute(situation);
    } else {
      chooseAction(situation);
    }
  }
  planWayOn();
}

void NavigationAgent::chooseEscape(const Situation& situation) {
  Heading move;
  switch (escape_.decide(situation, shield_, goal_, &move)) {
    case Escape::Outcome::kMove:
      goTo(situation, move.distance > 0.0 ? Decision::Source::kEscape : Decision::Source::kLookAround, move.direction,
           std::max(move.distance, parameters_.shield.shortest_step));
      return;
    case Escape::Outcome::kNoWay:
      goTo(situation, Decision::Source::kNoWay, situation.pose.yaw, 0.0);
      return;
    case Escape::Outcome::kDone:
      beginFrom(situation);
      chooseAction(situation);
      return;
  }
}

void NavigationAgent::chooseRoute(const Situation& situation) {
  constexpr int kBlocks = 3;
  for (int blocks = 0; blocks <= kBlocks; ++blocks) {
    switch (guide_status_) {
      case RouteGuide::Status::kClosed:
        goTo(situation, Decision::Source::kNoWay, situation.pose.yaw, 0.0);
        return;
      case RouteGuide::Status::kLookAround:
      case RouteGuide::Status::kLost:
        lookAround(situation);
        return;
      case RouteGuide::Status::kRoute:
        break;
    }
    if (leader_ == Leader::kNetwork) {
      chooseAction(situation);
      if (decision_.source != Decision::Source::kLookAround) {
        return;
      }
    } else if (followRoute(situation, Decision::Source::kRoute)) {
      return;
    }
    guide_.blockAhead();
    guide(situation);
  }
  lookAround(situation);
}

void NavigationAgent::chooseAction(const Situation& situation) {
  const ActionSet& actions = policy_.description().actions;
  const ShieldParameters& shield = parameters_.shield;
  const bool guided = network_knows_route_ && guide_status_ == RouteGuide::Status::kRoute;
  const double bearing = guided ? guide_.bearingAhead(situation.pose, parameters_.step.length) : 0.0;
  const int on_route = guided ? actions.nearest(bearing) : -1;
  for (const double clearance : {shield.clearance, shield.tight_clearance}) {
    double free = 0.0;
    const int best = preferredAction(situation, clearance, on_route, &free);
    if (best < 0) {
      continue;
    }
    // The next steering angle to it is no contradiction: the route lies between the two.
    const bool agrees = guided && (best == on_route || std::abs(actions.angle(best) - bearing) <= kAgreement);
    const bool follows = agrees || (guided && !leadsOn(situation, step_pose_.yaw + actions.angle(best), free));
    if (follows && followRoute(situation, Decision::Source::kNetwork)) {
      decision_.action = agrees ? best : on_route;
      return;
    }
    if (best == on_route && free < shield.shortest_step) {
      break;
    }
    goTo(situation, Decision::Source::kNetwork, step_pose_.yaw + actions.angle(best), free);
    decision_.action = best;
    look_around_turn_ = 0.0;
    return;
  }
  lookAround(situation);
}

bool NavigationAgent::leadsOn(const Situation& situation, double direction, double distance) {
  const Point2 here{situation.pose.x, situation.pose.y};
  const Point2 waypoint = pointAlong(situation.pose, direction, distance);
  return guide_.isPassable(here, waypoint) && findOn(waypoint) &&
         distance + route_on_.length <= guide_.route().length + parameters_.memory.freedom &&
         !comesBackTo(here, route_on_.points);
}

/// From a waypoint, if it is not known already.
bool NavigationAgent::findOn(const Point2& waypoint) {
  if (!route_on_.points.empty() && distanceBetween(route_on_.points.front(), waypoint) < 1e-6) {
    return true;
  }
  const bool found = guide_.findFrom(waypoint, &route_on_);
  if (!found) {
    route_on_.points.clear();
  }
  return found;
}

int NavigationAgent::preferredAction(const Situation& situation, double clearance, int on_route, double* best_free) {
  const ActionSet& actions = policy_.description().actions;
  int best = -1;
  for (int action = 0; action < actions.size(); ++action) {
    const auto i = static_cast<std::size_t>(action);
    const double free = parameters_.shield_enabled ? freeDistance(situation, step_pose_.yaw + actions.angle(action),
                                                                  parameters_.step.length, clearance)
                                                   : parameters_.step.length;
    decision_.allowed[i] = free >= parameters_.shield.shortest_step || action == on_route;
    const bool preferred =
        best < 0 || imposed_action_ == action ||
        (imposed_action_ != best && decision_.preferences[i] > decision_.preferences[static_cast<std::size_t>(best)]);
    if (decision_.allowed[i] && preferred) {
      best = action;
      *best_free = free;
    }
  }
  return best;
}

bool NavigationAgent::followRoute(const Situation& situation, Decision::Source source) {
  const ShieldParameters& shield = parameters_.shield;
  for (const double ahead : {1.0, 0.5}) {
    const Point2 target = guide_.pointAhead(ahead * parameters_.step.length);
    const double distance = distanceBetween(situation.pose, target);
    const double wanted = std::min(distance, shield.shortest_step);
    const double direction = directionTo(situation.pose, target);
    for (double aside = 0.0; aside < (ahead < 1.0 ? kFarthestAside : 0.5 * kAsideStep); aside += kAsideStep) {
      for (const double side : {1.0, -1.0}) {
        const double free =
            freeDistance(situation, direction + side * aside, std::max(distance, wanted), shield.tight_clearance);
        if (free >= wanted && (free >= 0.9 * distance || ahead < 1.0)) {
          goTo(situation, source, direction + side * aside, free);
          decision_.on_route = true;
          look_around_turn_ = 0.0;
          return true;
        }
      }
    }
  }
  return false;
}

bool NavigationAgent::chooseGoalInSight(const Situation& situation) {
  const double distance = distanceBetween(situation.pose, decision_.destination);
  if (!parameters_.shield_enabled || distance > parameters_.goal_in_sight) {
    return false;
  }
  const double direction = directionTo(situation.pose, decision_.destination);
  const bool seen = std::abs(normalizeAngle(direction - situation.pose.yaw)) <= M_PI_2;
  if (!seen || freeDistance(situation, direction, distance, parameters_.shield.tight_clearance) <
                   distance - 0.5 * parameters_.goal_tolerance) {
    return false;
  }
  goTo(situation, Decision::Source::kGoalInSight, direction, distance);
  return true;
}

void NavigationAgent::lookAround(const Situation& situation) {
  if (look_around_turn_ == 0.0) {
    const double bearing = normalizeAngle(directionTo(situation.pose, goal_) - situation.pose.yaw);
    look_around_turn_ = bearing < 0.0 ? -1.0 : 1.0;
  }
  goTo(situation, Decision::Source::kLookAround, situation.pose.yaw + look_around_turn_ * 2.0,
       parameters_.shield.shortest_step);
  decision_.way_on.clear();
}

void NavigationAgent::goTo(const Situation& situation, Decision::Source source, double direction, double distance) {
  decision_.source = source;
  decision_.action = -1;
  decision_.on_route = false;
  decision_.direction = normalizeAngle(direction);
  decision_.waypoint = pointAlong(situation.pose, direction, distance);
}

void NavigationAgent::planWayOn() {
  std::vector<Point2>& way_on = decision_.way_on;
  way_on.clear();
  const bool leads_on = decision_.source == Decision::Source::kNetwork || decision_.source == Decision::Source::kRoute ||
                        decision_.source == Decision::Source::kEscape ||
                        decision_.source == Decision::Source::kLookAround;
  if (!leads_on || !parameters_.memory.enabled || guide_status_ != RouteGuide::Status::kRoute) {
    return;
  }
  if (decision_.on_route) {
    guide_.pointsAhead(distanceBetween(step_pose_, decision_.waypoint), &way_on);
  } else if (findOn(decision_.waypoint)) {
    way_on.assign(route_on_.points.begin() + 1, route_on_.points.end());
  }
}

double NavigationAgent::freeDistance(const Situation& situation, double direction, double limit,
                                     double clearance) const {
  return shield_.freeDistance({}, direction - situation.pose.yaw, limit, clearance);
}

}  // namespace lstm_planner
