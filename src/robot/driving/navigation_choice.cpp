#include <algorithm>
#include <cmath>

#include "lstm_planner/robot/driving/navigation_agent.hpp"

namespace lstm_planner {

namespace {

/// Directions beside the route that are tried when its first metres are not free: steps and farthest, rad.
constexpr double kAsideStep = 0.0873;
constexpr double kFarthestAside = 1.05;

}  // namespace

void NavigationAgent::choose(const Situation& situation) {
  if (parameters_.escape.enabled && guide_status_ == RouteGuide::Status::kLost) {
    lead(Phase::kBoundary);
  }
  decision_.on_route = false;
  if (!chooseGoalInSight(situation)) {
    chooseByPhase(situation);
  }
  planWayOn();
}

void NavigationAgent::chooseByPhase(const Situation& situation) {
  switch (phase_) {
    case Phase::kLeader:
      return chooseAction(situation);
    case Phase::kRoute:
      return chooseRoute(situation);
    case Phase::kBoundary:
      return chooseEscape(situation);
  }
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
      guide(situation);
      chooseByPhase(situation);
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
    if (followRoute(situation)) {
      return;
    }
    guide_->blockAhead();
    guide(situation);
  }
  lookAround(situation);
}

void NavigationAgent::chooseAction(const Situation& situation) {
  const ShieldParameters& shield = parameters_.shield;
  for (const double clearance : {shield.clearance, shield.tight_clearance}) {
    double free = 0.0;
    const int best = allowedFavourite(situation, clearance, &free);
    if (best < 0) {
      continue;
    }
    const double direction = step_pose_.yaw + policy_.description().actions.angle(best);
    goTo(situation, parameters_.leader == Leader::kNone ? Decision::Source::kGreedy : Decision::Source::kNetwork,
         direction, free);
    decision_.action = best;
    look_around_turn_ = 0.0;
    return;
  }
  lookAround(situation);
}

/// The action that the leader prefers among those that the shield allows, or the imposed one; -1 when it allows none.
int NavigationAgent::allowedFavourite(const Situation& situation, double clearance, double* best_free) {
  const ActionSet& actions = policy_.description().actions;
  int best = -1;
  for (int action = 0; action < actions.size(); ++action) {
    const auto i = static_cast<std::size_t>(action);
    const double free = parameters_.shield_enabled ? freeDistance(situation, step_pose_.yaw + actions.angle(action),
                                                                  parameters_.step.length, clearance)
                                                   : parameters_.step.length;
    decision_.allowed[i] = free >= parameters_.shield.shortest_step;
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

bool NavigationAgent::followRoute(const Situation& situation) {
  const ShieldParameters& shield = parameters_.shield;
  for (const double ahead : {1.0, 0.5}) {
    const Point2 target = guide_->pointAhead(ahead * parameters_.step.length);
    const double distance = distanceBetween(situation.pose, target);
    const double wanted = std::min(distance, shield.shortest_step);
    const double direction = directionTo(situation.pose, target);
    for (double aside = 0.0; aside < (ahead < 1.0 ? kFarthestAside : 0.5 * kAsideStep); aside += kAsideStep) {
      for (const double side : {1.0, -1.0}) {
        const double free =
            freeDistance(situation, direction + side * aside, std::max(distance, wanted), shield.tight_clearance);
        if (free >= wanted && (free >= 0.9 * distance || ahead < 1.0)) {
          goTo(situation, Decision::Source::kRoute, direction + side * aside, free);
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
  if (decision_.on_route) {
    guide_->pointsAhead(distanceBetween(step_pose_, decision_.waypoint), &way_on);
  }
}

double NavigationAgent::freeDistance(const Situation& situation, double direction, double limit,
                                     double clearance) const {
  return shield_.freeDistance({}, direction - situation.pose.yaw, limit, clearance);
}

}  // namespace lstm_planner
