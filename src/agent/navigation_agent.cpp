#include "lstm_planner/agent/navigation_agent.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lstm_planner {

const char* toString(Decision::Source source) {
  switch (source) {
    case Decision::Source::kNetwork:
      return "network";
    case Decision::Source::kGoalInSight:
      return "goal in sight";
    case Decision::Source::kEscape:
      return "escape";
    case Decision::Source::kLookAround:
      return "look around";
    case Decision::Source::kArrived:
      return "arrived";
    case Decision::Source::kNoWay:
      return "no way";
  }
  return "unknown";
}

NavigationAgent::NavigationAgent(DrivePolicy policy, const AgentParameters& parameters)
    : policy_(std::move(policy)),
      parameters_((validate(parameters), parameters)),
      shield_(parameters.shield.footprint_radius, parameters.shield.tight_clearance, parameters.shield.reach),
      escape_(parameters.escape, parameters.shield) {
  checkFits(policy_.description(), parameters.step.length, parameters.shield.footprint_radius);
  const auto actions = static_cast<std::size_t>(policy_.description().actions.size());
  decision_.preferences.resize(actions);
  decision_.allowed.resize(actions);
}

void NavigationAgent::setGoal(const Point2& goal) {
  goal_ = goal;
  policy_.reset();
  has_step_ = false;
  escaping_ = false;
  best_distance_ = 0.0;
  steps_since_best_ = 0;
  driven_since_best_ = 0.0;
  look_around_turn_ = 0.0;
  decision_.source = Decision::Source::kLookAround;
  decision_.action = -1;
  decision_.step = 0;
}

const Decision& NavigationAgent::update(const Situation& situation) {
  shield_.show(situation.obstacles);
  if (decision_.source == Decision::Source::kNoWay) {
    return decision_;
  }
  if (distanceBetween(situation.pose, goal_) <= parameters_.goal_tolerance) {
    goTo(situation, Decision::Source::kArrived, directionTo(situation.pose, goal_),
         distanceBetween(situation.pose, goal_));
    return decision_;
  }
  if (!has_step_ || stepIsOver(situation)) {
    noteProgress(situation);
    advanceNetwork(situation);
    choose(situation);
  } else if (isStalled(situation)) {
    stall_time_ = situation.time;
    lookAround(situation);
  } else if (!wayIsFree(situation)) {
    choose(situation);
  }
  return decision_;
}

Decision NavigationAgent::preview(const Situation& situation, const Point2& goal) const {
  NavigationAgent fresh(*this);
  fresh.step_listener_ = nullptr;
  fresh.setGoal(goal);
  return fresh.update(situation);
}

bool NavigationAgent::stepIsOver(const Situation& situation) const {
  const StepParameters& step = parameters_.step;
  const double moved = distanceBetween(step_pose_, situation.pose);
  if (distanceBetween(situation.pose, decision_.waypoint) < step.reached) {
    return true;
  }
  if (decision_.source == Decision::Source::kEscape) {
    // Half way already, so that the robot need not slow down for the next bend.
    return moved >= 0.5 * parameters_.escape.follow_step;
  }
  const double turned = std::abs(normalizeAngle(situation.pose.yaw - step_pose_.yaw));
  return moved >= step.length || turned >= step.turn ||
         (elapsed(situation) >= step.period && hasStirred(situation, step_pose_));
}

bool NavigationAgent::hasStirred(const Situation& situation, const Pose2& since) const {
  return distanceBetween(since, situation.pose) >= parameters_.step.still_distance ||
         std::abs(normalizeAngle(situation.pose.yaw - since.yaw)) >= parameters_.step.still_turn;
}

double NavigationAgent::elapsed(const Situation& situation) const {
  // A clock that jumped back (a simulation started anew) must not stop the steps for ever.
  return std::abs(situation.time - step_time_);
}

bool NavigationAgent::isStalled(const Situation& situation) {
  if (hasStirred(situation, stall_pose_)) {
    stall_pose_ = situation.pose;
    stall_time_ = situation.time;
  }
  return std::abs(situation.time - stall_time_) >= parameters_.step.stall;
}

bool NavigationAgent::wayIsFree(const Situation& situation) const {
  if (decision_.source == Decision::Source::kLookAround) {
    return true;
  }
  const double distance = std::min(distanceBetween(situation.pose, decision_.waypoint), parameters_.step.length);
  const double direction = directionTo(situation.pose, decision_.waypoint);
  return freeDistance(situation, direction, distance, parameters_.shield.tight_clearance) >= distance - 0.02;
}

void NavigationAgent::noteProgress(const Situation& situation) {
  const double distance = distanceBetween(situation.pose, goal_);
  if (!has_step_ || distance < best_distance_ - parameters_.escape.progress) {
    best_distance_ = distance;
    steps_since_best_ = 0;
    driven_since_best_ = 0.0;
  } else {
    ++steps_since_best_;
    driven_since_best_ += distanceBetween(step_pose_, situation.pose);
  }
}

void NavigationAgent::advanceNetwork(const Situation& situation) {
  const PolicyDescription& description = policy_.description();
  double previous = 0.0;
  if (has_step_ && decision_.action >= 0) {
    previous = description.actions.angle(decision_.action);
  } else if (has_step_) {
    // The escape's ways lie between the steering angles: tell the network the nearest one, as the recorder would.
    previous =
        description.actions.angle(description.actions.nearest(normalizeAngle(decision_.direction - step_pose_.yaw)));
  }
  const Observation observation =
      observe(situation.sectors, situation.pose, goal_, previous, description.encoder.position_cell);
  const Eigen::VectorXf& preferences = policy_.advance(observation);
  std::copy(preferences.data(), preferences.data() + preferences.size(), decision_.preferences.begin());
  step_pose_ = situation.pose;
  step_time_ = situation.time;
  stall_pose_ = situation.pose;
  stall_time_ = situation.time;
  has_step_ = true;
  ++decision_.step;
  imposed_action_ = step_listener_ ? step_listener_(situation, observation) : std::nullopt;
}

void NavigationAgent::choose(const Situation& situation) {
  const EscapeParameters& escape = parameters_.escape;
  const bool impatient = steps_since_best_ >= escape.patience_steps || driven_since_best_ >= escape.patience_distance;
  if (escape.enabled && !escaping_ && impatient) {
    escaping_ = true;
    escape_.begin(best_distance_ - escape.progress);
  }
  if (chooseGoalInSight(situation)) {
    return;
  }
  if (escaping_) {
    chooseEscape(situation);
  } else {
    chooseAction(situation);
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
      escaping_ = false;
      best_distance_ = distanceBetween(situation.pose, goal_);
      steps_since_best_ = 0;
      driven_since_best_ = 0.0;
      chooseAction(situation);
      return;
  }
}

void NavigationAgent::chooseAction(const Situation& situation) {
  const ActionSet& actions = policy_.description().actions;
  const ShieldParameters& shield = parameters_.shield;
  for (const double clearance : {shield.clearance, shield.tight_clearance}) {
    int best = -1;
    double best_free = 0.0;
    for (int action = 0; action < actions.size(); ++action) {
      const auto i = static_cast<std::size_t>(action);
      const double free = parameters_.shield_enabled ? freeDistance(situation, step_pose_.yaw + actions.angle(action),
                                                                    parameters_.step.length, clearance)
                                                     : parameters_.step.length;
      decision_.allowed[i] = free >= shield.shortest_step;
      const bool preferred =
          best < 0 || imposed_action_ == action ||
          (imposed_action_ != best && decision_.preferences[i] > decision_.preferences[static_cast<std::size_t>(best)]);
      if (decision_.allowed[i] && preferred) {
        best = action;
        best_free = free;
      }
    }
    if (best >= 0) {
      goTo(situation, Decision::Source::kNetwork, step_pose_.yaw + actions.angle(best), best_free);
      decision_.action = best;
      look_around_turn_ = 0.0;
      return;
    }
  }
  lookAround(situation);
}

bool NavigationAgent::chooseGoalInSight(const Situation& situation) {
  const double distance = distanceBetween(situation.pose, goal_);
  if (!parameters_.shield_enabled || distance > parameters_.goal_in_sight) {
    return false;
  }
  const double direction = directionTo(situation.pose, goal_);
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
}

void NavigationAgent::goTo(const Situation& situation, Decision::Source source, double direction, double distance) {
  decision_.source = source;
  decision_.action = -1;
  decision_.direction = normalizeAngle(direction);
  decision_.waypoint = pointAlong(situation.pose, direction, distance);
}

double NavigationAgent::freeDistance(const Situation& situation, double direction, double limit,
                                     double clearance) const {
  return shield_.freeDistance({}, direction - situation.pose.yaw, limit, clearance);
}

}  // namespace lstm_planner
