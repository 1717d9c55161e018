#include "lstm_planner/agent/rollout.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lstm_planner {

namespace {

/// Appends poses from the end of the plan to `end`, looking along the way.
void lineTo(const Point2& end, double spacing, std::vector<Pose2>* plan) {
  const Pose2 begin = plan->back();
  const double length = distanceBetween(begin, end);
  if (length <= 0.0) {
    return;
  }
  const double direction = directionTo(begin, end);
  const int poses = std::max(1, static_cast<int>(std::ceil(length / spacing)));
  const Point2 step{(end.x - begin.x) / poses, (end.y - begin.y) / poses};
  const std::size_t first = plan->size();
  plan->resize(first + static_cast<std::size_t>(poses));
  Pose2* pose = plan->data() + first;
  for (int i = 1; i < poses; ++i) {
    *pose++ = {begin.x + i * step.x, begin.y + i * step.y, direction};
  }
  *pose = {end.x, end.y, direction};
}

/// The free step from `at` (base frame) that leads most towards the goal; false when there is none.
bool stepTowards(const Point2& goal, const Shield& shield, const AgentParameters& agent, const ActionSet& actions,
                 double heading, Point2* at, double* direction) {
  const double distance = std::min(agent.step.length, distanceBetween(*at, goal));
  const double bearing = directionTo(*at, goal);
  const auto isFree = [&](double candidate) {
    return shield.freeDistance(*at, candidate, distance, agent.shield.clearance) >= distance;
  };
  std::pair<double, int> tried{0.0, -1};  // how far aside, and which action; of two as far aside the first comes first
  double next = bearing;
  // From the bearing on aside: what is measured costs more than what is compared.
  while (!isFree(next)) {
    std::pair<double, int> nearest{M_PI, -1};
    for (int action = 0; action < actions.size(); ++action) {
      const std::pair<double, int> candidate{std::abs(normalizeAngle(heading + actions.angle(action) - bearing)),
                                             action};
      if (candidate > tried && candidate < nearest) nearest = candidate;
    }
    if (nearest.second < 0) return false;
    tried = nearest;
    next = heading + actions.angle(nearest.second);
  }
  *direction = next;
  *at = pointAlong(*at, *direction, distance);
  return true;
}

/// Whether a direction was decided, and nothing is known of what comes behind the waypoint.
bool isOneStep(const Decision& decision) {
  return decision.source == Decision::Source::kNetwork || decision.source == Decision::Source::kGreedy;
}

}  // namespace

void rollOut(const Situation& situation, const Decision& decision, const Shield& shield, const Pose2& goal,
             const AgentParameters& agent, const RolloutParameters& parameters, std::vector<Pose2>* plan) {
  static const ActionSet actions;
  plan->clear();
  plan->push_back(situation.pose);
  if (decision.source != Decision::Source::kArrived) {
    lineTo(decision.waypoint, parameters.spacing, plan);
    for (const Point2& corner : decision.way_on) {
      lineTo(corner, parameters.spacing, plan);
    }
    const Point2 local_goal = toLocalFrame(situation.pose, decision.destination);
    Point2 at = toLocalFrame(situation.pose, decision.waypoint);
    double direction = decision.direction - situation.pose.yaw;
    if (isOneStep(decision) && distanceBetween(at, local_goal) > agent.step.length) {
      // Straight on for another step: a controller that looks ahead of the waypoint must not turn for the goal before
      // the leader has decided to.
      at = pointAlong(at, direction, shield.freeDistance(at, direction, agent.step.length, agent.shield.clearance));
      lineTo(toParentFrame(situation.pose, at), parameters.spacing, plan);
    }
    double left = distanceBetween(at, local_goal);
    const bool moves = decision.way_on.empty() && decision.source != Decision::Source::kLookAround;
    for (int step = 0; moves && step < parameters.steps && left > agent.goal_tolerance; ++step) {
      if (!stepTowards(local_goal, shield, agent, actions, direction, &at, &direction) ||
          distanceBetween(at, local_goal) > left) {
        break;  // From here the way to the goal would have to be guessed.
      }
      left = distanceBetween(at, local_goal);
      lineTo(toParentFrame(situation.pose, at), parameters.spacing, plan);
    }
  }
  lineTo(decision.destination, parameters.spacing, plan);
  const Pose2 last{decision.destination.x, decision.destination.y, goal.yaw};
  if (plan->size() == 1) {
    plan->push_back(last);
  }
  plan->back() = last;
}

}  // namespace lstm_planner
