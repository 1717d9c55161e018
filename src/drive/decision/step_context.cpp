#include "drive/decision/step_context.hpp"

#include <algorithm>

namespace lstm_planner {

namespace {

/// Directions beside the path that are tried when its first metres are not free: steps and farthest, rad.
constexpr double kAsideStep = 0.0873;
constexpr double kFarthestAside = 1.05;

constexpr double kLookAroundTurn = 2.0;  // rad

}  // namespace

Replanner::Answer StepContext::searchPath() const {
  if (replanner == nullptr) return Replanner::Answer::kRoute;
  decision->destination = goal;
  const Replanner::Answer answer = replanner->update(situation, goal, toleranceAfter(driven, parameters));
  if (answer == Replanner::Answer::kRoute) decision->destination = replanner->end();
  return answer;
}

double StepContext::freeDistance(double direction, double limit) const {
  return shield.freeDistance({}, direction - situation.pose.yaw, limit, parameters.shield.tight_clearance);
}

void StepContext::goTo(Decision::Choice choice, double direction, double distance) const {
  decision->choice = choice;
  decision->action = -1;
  decision->on_route = false;
  decision->direction = normalizeAngle(direction);
  decision->waypoint = pointAlong(situation.pose, direction, distance);
}

void StepContext::takeAction(int action, double distance) const {
  goTo(decision->leader, start_yaw + actions.angle(action), distance);
  decision->action = action;
  *look_around_turn = 0.0;
}

bool StepContext::followPath(Decision::Choice choice) const {
  for (const double ahead : {1.0, 0.5}) {
    const Point2 target = replanner->pointAhead(ahead * parameters.step.length);
    const double distance = distanceBetween(situation.pose, target);
    const double wanted = std::min(distance, parameters.shield.shortest_step);
    const double direction = directionTo(situation.pose, target);
    for (double aside = 0.0; aside < (ahead < 1.0 ? kFarthestAside : 0.5 * kAsideStep); aside += kAsideStep) {
      for (const double side : {1.0, -1.0}) {
        const double free = freeDistance(direction + side * aside, std::max(distance, wanted));
        if (free >= wanted && (free >= 0.9 * distance || ahead < 1.0)) {
          goTo(choice, direction + side * aside, free);
          decision->on_route = true;
          *look_around_turn = 0.0;
          return true;
        }
      }
    }
  }
  return false;
}

void StepContext::lookAround() const {
  if (*look_around_turn == 0.0) {
    const double bearing = normalizeAngle(directionTo(situation.pose, goal) - situation.pose.yaw);
    *look_around_turn = bearing < 0.0 ? -1.0 : 1.0;
  }
  goTo(Decision::Move::kLookAround, situation.pose.yaw + *look_around_turn * kLookAroundTurn,
       parameters.shield.shortest_step);
  decision->path_on.clear();
}

}  // namespace lstm_planner
