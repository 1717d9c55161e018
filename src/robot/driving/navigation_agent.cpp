#include "lstm_planner/robot/driving/navigation_agent.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "lstm_planner/robot/driving/observer.hpp"

namespace lstm_planner {

const char* toString(Decision::Source source) {
  switch (source) {
    case Decision::Source::kNetwork:
      return "network";
    case Decision::Source::kGreedy:
      return "greedy";
    case Decision::Source::kGoalInSight:
      return "goal in sight";
    case Decision::Source::kRoute:
      return "route";
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
      escape_(parameters.escape, parameters.shield),
      guide_(parameters.memory.enabled ? std::optional<RouteGuide>(parameters) : std::nullopt) {
  checkFits(policy_.description(), parameters.step.length, parameters.shield.footprint_radius);
  const auto actions = static_cast<std::size_t>(policy_.description().actions.size());
  decision_.preferences.resize(actions);
  decision_.allowed.resize(actions);
  if (guide_) decision_.way_on.reserve(guide_->route().points.capacity());
}

void NavigationAgent::setGoal(const Point2& goal) {
  goal_ = goal;
  decision_.destination = goal;
  policy_.reset();
  if (guide_) guide_->begin(goal);
  guide_status_ = RouteGuide::Status::kRoute;
  trace_.clear();
  decision_.way_on.clear();
  has_step_ = false;
  lead(Phase::kLeader);
  best_distance_ = 0.0;
  steps_since_best_ = 0;
  driven_since_best_ = 0.0;
  look_around_turn_ = 0.0;
  decision_.source = Decision::Source::kLookAround;
  decision_.action = -1;
  decision_.preferred = -1;
  decision_.step = 0;
}

void NavigationAgent::moveGoal(const Point2& goal) {
  const auto isGoal = [this](const Point2& place) { return distanceBetween(place, goal_) < 1e-6; };
  if (isGoal(decision_.waypoint)) {
    decision_.waypoint = goal;
    decision_.direction = directionTo(step_pose_, goal);
  }
  if (isGoal(decision_.destination)) {
    decision_.destination = goal;
  }
  if (!decision_.way_on.empty() && isGoal(decision_.way_on.back())) {
    decision_.way_on.back() = goal;
  }
  if (has_step_) {
    best_distance_ = distanceBetween(best_position_, goal);
  }
  if (guide_) guide_->moveGoal(goal);
  escape_.moveGoal(goal_, goal, targetDistance());
  goal_ = goal;
}

void NavigationAgent::restart() {
  if (guide_) guide_->forget();
  setGoal(goal_);
}

const Decision& NavigationAgent::update(const Situation& situation) {
  shield_.show(situation.obstacles);
  if (decision_.source == Decision::Source::kNoWay) {
    return decision_;
  }
  if (distanceBetween(situation.pose, decision_.destination) <= parameters_.goal_tolerance) {
    goTo(situation, Decision::Source::kArrived, directionTo(situation.pose, decision_.destination),
         distanceBetween(situation.pose, decision_.destination));
    decision_.way_on.clear();
    return decision_;
  }
  if (!has_step_ || stepIsOver(situation)) {
    noteProgress(situation);
    losePatience();
    guide(situation);
    beginStep(situation);
    choose(situation);
  } else if (isStalled(situation)) {
    stall_time_ = situation.time;
    if (decision_.on_route) {
      guide_->blockAhead();
      guide(situation);
      choose(situation);
    } else {
      lookAround(situation);
    }
  } else if (!wayIsFree(situation)) {
    guide(situation);
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
  if (!has_step_ || distance < targetDistance()) {
    beginFrom(situation);
  } else {
    ++steps_since_best_;
    driven_since_best_ += distanceBetween(step_pose_, situation.pose);
  }
}

void NavigationAgent::beginFrom(const Situation& situation) {
  best_position_ = {situation.pose.x, situation.pose.y};
  best_distance_ = distanceBetween(best_position_, goal_);
  steps_since_best_ = 0;
  driven_since_best_ = 0.0;
  if (guide_) guide_->noteProgress();
  lead(Phase::kLeader);
}

void NavigationAgent::lead(Phase phase) {
  if (phase == Phase::kLeader && parameters_.leader == Leader::kRoute) phase = Phase::kRoute;
  if (phase == Phase::kBoundary && phase_ != phase) {
    escape_.begin(targetDistance());
  }
  phase_ = phase;
}

bool NavigationAgent::isOutOfPatience(double times) const {
  const EscapeParameters& escape = parameters_.escape;
  return steps_since_best_ >= times * escape.patience_steps || driven_since_best_ >= times * escape.patience_distance;
}

void NavigationAgent::losePatience() {
  const EscapeParameters& escape = parameters_.escape;
  if (!escape.enabled) {
    return;
  }
  if (phase_ == Phase::kLeader && isOutOfPatience(1.0)) {
    lead(guide_ ? Phase::kRoute : Phase::kBoundary);
  }
  if (phase_ != Phase::kBoundary && isOutOfPatience(escape.last_resort)) {
    lead(Phase::kBoundary);
  }
}

void NavigationAgent::guide(const Situation& situation) {
  if (!guide_) {
    return;
  }
  if (phase_ == Phase::kLeader) {
    guide_->watch(situation);
    guide_status_ = RouteGuide::Status::kRoute;
    decision_.destination = goal_;
    return;
  }
  guide_status_ = guide_->update(situation);
  decision_.destination = guide_status_ == RouteGuide::Status::kRoute ? guide_->end() : goal_;
}

void NavigationAgent::beginStep(const Situation& situation) {
  const double cell = policy_.description().encoder.position_cell;
  const Observation observation = observe(situation, goal_, previousAction(), cell, &trace_);
  advanceNetwork(observation);
  step_pose_ = situation.pose;
  step_time_ = situation.time;
  stall_pose_ = situation.pose;
  stall_time_ = situation.time;
  has_step_ = true;
  ++decision_.step;
  imposed_action_ = step_listener_ ? step_listener_(situation, observation) : std::nullopt;
}

double NavigationAgent::previousAction() const {
  const ActionSet& actions = policy_.description().actions;
  if (!has_step_) {
    return 0.0;
  }
  // The rescue's ways lie between the steering angles: tell the network the nearest one, as the recorder would.
  return actions.angle(decision_.action >= 0
                           ? decision_.action
                           : actions.nearest(normalizeAngle(decision_.direction - step_pose_.yaw)));
}

void NavigationAgent::advanceNetwork(const Observation& observation) {
  if (parameters_.leader != Leader::kNetwork) {
    preferGoal(observation);
    return;
  }
  const Eigen::VectorXf& preferences = policy_.advance(observation);
  std::copy(preferences.data(), preferences.data() + preferences.size(), decision_.preferences.begin());
  Eigen::Index preferred = 0;
  preferences.maxCoeff(&preferred);
  decision_.preferred = static_cast<int>(preferred);
}

void NavigationAgent::preferGoal(const Observation& observation) {
  const ActionSet& actions = policy_.description().actions;
  for (int action = 0; action < actions.size(); ++action) {
    const double off = std::abs(normalizeAngle(actions.angle(action) - observation.goal_bearing));
    decision_.preferences[static_cast<std::size_t>(action)] = static_cast<float>(-off);
  }
}

}  // namespace lstm_planner
