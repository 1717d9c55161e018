#include "lstm_planner/drive/decision/navigation_agent.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "drive/decision/step_context.hpp"
#include "drive/decision/step_leaders.hpp"
#include "lstm_planner/drive/decision/action_choice.hpp"
#include "lstm_planner/drive/decision/arrival.hpp"
#include "lstm_planner/drive/decision/observer.hpp"
#include "lstm_planner/drive/perception/reach.hpp"

namespace lstm_planner {

namespace {

constexpr double kSamePlace = 1e-6;  // m

/// A turn by so much (rad) counts as much as a whole step of a detour.
constexpr double kTurnOfAStep = M_PI;

/// Why a leader leads.
const char* const kNewGoal = "new goal";
const char* const kChosen = "the parameter leader was changed";
const char* const kNearerThanEver = "nearer to the goal than ever";
const char* const kNoProgress = "no progress";
const char* const kNoProgressForLong = "no progress for very long";
const char* const kTooShort = "the scanner does not reach as far as the network needs";
const char* const kFarEnough = "the scanner reaches as far as the network needs";
const char* const kMemoryWrong = "what is remembered was wrong too often";

/// The goal is so near that the robot would go straight to it (m), but something that is remembered is in between.
bool isHidden(const LocalMap& memory, const Pose2& pose, const Point2& goal, double near) {
  if (distanceBetween(pose, goal) > near) return false;
  return !memory.isFree({pose.x, pose.y}, goal, LocalMap::Passage::kTight);
}

/// Only a network that leads must fit.
void checkLeader(const PolicyDescription& description, const AgentParameters& parameters) {
  if (parameters.leader == Leader::kNetwork) checkFits(description, parameters.step.length);
}

std::optional<OutOfView> outOfViewOf(const Shield& shield) {
  if (shield.footprint().isCircle()) return std::nullopt;
  return OutOfView(shield.footprint());
}

}  // namespace

NavigationAgent::NavigationAgent(DrivePolicy policy, const AgentParameters& parameters)
    : policy_(std::move(policy)),
      parameters_((validate(parameters), parameters)),
      chosen_(parameters.leader),
      shield_(footprintOf(parameters.shield), parameters.shield.tight_clearance, parameters.shield.reach),
      out_of_view_(outOfViewOf(shield_)),
      bug_algorithm_(parameters.escape, parameters.shield),
      replanner_(parameters.memory.enabled ? std::make_optional<Replanner>(parameters.memory, parameters.shield)
                                           : std::nullopt),
      bound_(parameters.detour),
      clock_(parameters.step),
      progress_(parameters.escape.progress) {
  checkLeader(policy_.description(), parameters);
  const auto actions = static_cast<std::size_t>(policy_.description().actions.size());
  decision_.preferences.resize(actions);
  decision_.allowed.resize(actions);
  if (replanner_) decision_.path_on.reserve(replanner_->route().points.capacity());
}

void NavigationAgent::change(const AgentParameters& parameters) {
  AgentParameters changed = parameters_;
  changed.leader = parameters.leader;
  changed.goal_tolerance = parameters.goal_tolerance;
  changed.goal_in_sight = parameters.goal_in_sight;
  changed.escape.patience_steps = parameters.escape.patience_steps;
  changed.escape.patience_distance = parameters.escape.patience_distance;
  changed.escape.last_resort = parameters.escape.last_resort;
  validate(changed);
  checkLeader(policy_.description(), changed);
  const Leader leader = leaderBy(changed);
  parameters_ = changed;
  choose(leader, kChosen);
}

/// As the parameters say; but the path through what is remembered in place of a network that sees too little.
Leader NavigationAgent::leaderBy(const AgentParameters& parameters) const {
  const bool is_network = parameters.leader == Leader::kNetwork && reach_ > 0.0;
  if (!is_network || reachesFarEnough(policy_.description(), reach_)) return parameters.leader;
  if (!replanner_) throw std::invalid_argument(reachProblem(policy_.description(), reach_));
  return Leader::kRoute;
}

void NavigationAgent::choose(Leader leader, const char* why) {
  const bool is_led_as_chosen = decision_.leader == chosen_;
  if (is_led_as_chosen && leader != chosen_) lead(leader, why);
  chosen_ = leader;
}

std::string NavigationAgent::standInWarning() const {
  return chosen_ == parameters_.leader ? "" : lstm_planner::standInWarning(policy_.description(), reach_);
}

void NavigationAgent::perceive(const Situation& situation) {
  checkPose(situation.pose);
  situation_ = situation;
  reach_ = std::max(reach_, situation_.profile.farthest_range);
  const Leader leader = leaderBy(parameters_);
  choose(leader, leader == parameters_.leader ? kFarEnough : kTooShort);
  shield_.show(situation_.obstacles);
  if (out_of_view_) {
    out_of_view_->show(situation_);
    shield_.add(out_of_view_->points());
  }
  shield_.add(situation_.marked);
}

void NavigationAgent::mark(const std::vector<Point2>& obstacles) {
  situation_.marked = obstacles;
  shield_.add(obstacles);
}

Decision NavigationAgent::preview(const Point2& goal) const {
  checkGoal(situation_.pose, goal);
  NavigationAgent fresh(*this);
  fresh.step_listener_ = nullptr;
  fresh.setGoal(goal);
  return fresh.decide();
}

void NavigationAgent::setGoal(const Point2& goal) {
  goal_ = goal;
  policy_.reset();
  if (replanner_) replanner_->start();
  bound_.start();
  trace_.clear();
  clock_.clear();
  progress_.clear();
  driven_ = 0.0;
  look_around_turn_ = 0.0;
  lead(chosen_, kNewGoal);
  decision_.choice = Move::kLookAround;
  decision_.action = -1;
  decision_.preferred = -1;
  decision_.along_path = -1;
  decision_.destination = goal;
  decision_.goal_seems = Decision::GoalSeems::kReachable;
  decision_.overruled = Overruled::kNo;
  decision_.regret = 0.0;
  decision_.path_on.clear();
  decision_.step = 0;
}

void NavigationAgent::moveGoal(const Point2& goal) {
  const auto follow = [&](Point2* place) {
    if (distanceBetween(*place, goal_) >= 1e-6) return false;
    *place = goal;
    return true;
  };
  if (follow(&decision_.waypoint)) decision_.direction = directionTo(clock_.pose(), goal);
  follow(&decision_.destination);
  if (!decision_.path_on.empty()) follow(&decision_.path_on.back());
  if (progress_.hasBest()) progress_.moveBest(distanceBetween(best_position_, goal));
  if (replanner_) replanner_->moveGoal(goal_, goal);
  bug_algorithm_.moveGoal(goal_, goal);
  goal_ = goal;
}

void NavigationAgent::restart() {
  if (replanner_) replanner_->forget();
  if (out_of_view_) out_of_view_->forget();
  setGoal(goal_);
}

const Decision& NavigationAgent::decide() {
  checkGoal(situation_.pose, goal_);
  if (decision_.choice == Move::kNoPath) {
    return decision_;
  }
  if (distanceBetween(situation_.pose, decision_.destination) <= parameters_.goal_tolerance) {
    arrive();
    return decision_;
  }
  if (!clock_.hasStep() || stepIsOver()) {
    noteProgress();
    losePatience();
    startStep();
    decideStep();
  } else if (clock_.isStalled(situation_)) {
    tryAnotherWay();
  } else if (!pathIsFree()) {
    decideStep();
  }
  return decision_;
}

/// It stands, so what is ahead is blocked by something that it does not see. If it stands still after that, it is held
/// itself, e.g. by an emergency stop: then nothing was learned about the place, and nothing more will be.
void NavigationAgent::tryAnotherWay() {
  if (clock_.stalls() > 1) {
    if (!blocked_) return;
    replanner_->unblock(*blocked_);
    blocked_.reset();
    decideStep();
    return;
  }
  blocked_.reset();
  if (!replanner_ || !(decision_.on_route || isOneStep(decision_))) {
    context().lookAround();
    return;
  }
  blocked_ = decision_.on_route ? replanner_->blockAhead()
                                : replanner_->blockTowards({situation_.pose.x, situation_.pose.y}, decision_.waypoint);
  decideStep();
}

void NavigationAgent::arrive() {
  const Choice choice = countsAsArrival(decision_, goal_, parameters_) ? Move::kArrived : Move::kNoPath;
  context().goTo(choice, directionTo(situation_.pose, decision_.destination),
                 distanceBetween(situation_.pose, decision_.destination));
  decision_.path_on.clear();
}

bool NavigationAgent::stepIsOver() const {
  if (decision_.choice == Leader::kEscape) {
    // Half way already, so that the robot need not slow down for the next bend.
    return distanceBetween(situation_.pose, decision_.waypoint) < parameters_.step.reached ||
           clock_.moved(situation_) >= 0.5 * parameters_.escape.follow_step;
  }
  return clock_.isOver(situation_, decision_.waypoint);
}

bool NavigationAgent::pathIsFree() {
  if (decision_.choice == Move::kLookAround) {
    return true;
  }
  const double distance = std::min(distanceBetween(situation_.pose, decision_.waypoint), parameters_.step.length);
  const double direction = directionTo(situation_.pose, decision_.waypoint);
  return context().freeDistance(direction, distance) >= distance - 0.02;
}

void NavigationAgent::noteProgress() {
  const bool is_first = !progress_.hasBest();
  const double driven = is_first ? 0.0 : clock_.moved(situation_);
  driven_ += driven;
  if (progress_.note(distanceBetween(situation_.pose, goal_), driven)) {
    startFrom(is_first ? kNewGoal : kNearerThanEver);
  }
}

/// The robot has never been nearer to the goal: the leader of the parameters leads from here.
void NavigationAgent::startFrom(const char* why) {
  best_position_ = {situation_.pose.x, situation_.pose.y};
  progress_.restart(distanceBetween(best_position_, goal_));
  if (replanner_) replanner_->noteProgress(best_position_, goal_);
  lead(chosen_, why);
}

void NavigationAgent::lead(Leader leader, const char* why) {
  if (leader == Leader::kEscape) {
    if (decision_.leader == leader) return;
    bug_algorithm_.start();
  }
  decision_.leader = leader;
  decision_.why = why;
}

bool NavigationAgent::isOutOfPatience(double times) const {
  const EscapeParameters& escape = parameters_.escape;
  return progress_.steps() >= times * escape.patience_steps || progress_.driven() >= times * escape.patience_distance;
}

void NavigationAgent::losePatience() {
  if (!parameters_.escape.enabled || decision_.leader == Leader::kEscape) return;
  if (replanner_ && isOutOfPatience(parameters_.escape.last_resort)) lead(Leader::kEscape, kNoProgressForLong);
  if (!replanner_ && isOutOfPatience(1.0)) lead(Leader::kEscape, kNoProgress);
}

void NavigationAgent::startStep() {
  const double cell = policy_.description().encoder.position_cell;
  const Observation observation = observe(situation_, goal_, previousAction(), cell, &trace_);
  imposed_action_.reset();
  advanceNetwork(observation);
  bound_.endStep(drivenShare());
  clock_.start(situation_);
  ++decision_.step;
  if (!step_listener_) return;
  const std::optional<int> steered = step_listener_(situation_, observation);
  if (steered) imposed_action_ = steered;
}

/// Of the step that ends here. Turning counts, too: else a network that turns on the spot would never be stopped.
double NavigationAgent::drivenShare() const {
  if (!clock_.hasStep()) return 0.0;
  const double planned = std::max(kSamePlace, distanceBetween(clock_.pose(), decision_.waypoint));
  const double turned = std::abs(normalizeAngle(situation_.pose.yaw - clock_.pose().yaw));
  return std::min(1.0, clock_.moved(situation_) / planned + turned / kTurnOfAStep);
}

double NavigationAgent::previousAction() const {
  const ActionSet& actions = policy_.description().actions;
  if (!clock_.hasStep()) {
    return 0.0;
  }
  // Remembered paths lie between the steering angles: tell the network the nearest one, as the recorder would.
  return actions.angle(decision_.action >= 0
                           ? decision_.action
                           : actions.nearest(normalizeAngle(decision_.direction - clock_.pose().yaw)));
}

void NavigationAgent::advanceNetwork(const Observation& observation) {
  if (chosen_ != Leader::kNetwork) {
    decision_.preferred = -1;
    preferBearing(policy_.description().actions, observation.goal_bearing, &decision_.preferences);
    return;
  }
  const Eigen::VectorXf& preferences = policy_.advance(observation);
  std::copy(preferences.data(), preferences.data() + preferences.size(), decision_.preferences.begin());
  Eigen::Index preferred = 0;
  preferences.maxCoeff(&preferred);
  decision_.preferred = static_cast<int>(preferred);
  if (!replanner_ && parameters_.draw_after > 0 && progress_.steps() >= parameters_.draw_after) {
    imposed_action_ = drawAction(decision_.preferences, static_cast<std::uint64_t>(decision_.step));
    decision_.preferred = *imposed_action_;
  }
}

void NavigationAgent::decideStep() {
  const StepContext step = context();
  const Answer answer = step.searchPath();
  if (parameters_.escape.enabled && answer == Answer::kLost) {
    lead(Leader::kEscape, kMemoryWrong);
  }
  decision_.on_route = false;
  decision_.overruled = Overruled::kNo;
  decision_.along_path = -1;
  decision_.regret = 0.0;
  decision_.path_on.clear();
  bound_.choose(0.0);
  if (!chooseGoalInSight(step)) {
    decideAsLed(step, answer);
  }
  decision_.regret_used = bound_.used();
  decision_.regret_allowed = bound_.allowed(driven_);
  decision_.goal_seems = judgeGoal(answer);
  if (decision_.on_route) {
    replanner_->pointsAhead(distanceBetween(clock_.pose(), decision_.waypoint), &decision_.path_on);
  } else if (!isOneStep(decision_)) {
    decision_.path_on.clear();
  }
}

Decision::GoalSeems NavigationAgent::judgeGoal(Answer answer) const {
  using GoalSeems = Decision::GoalSeems;
  if (!replanner_ || decision_.leader == Leader::kEscape) return GoalSeems::kReachable;
  if (answer == Answer::kLookAround || answer == Answer::kNoPath) {
    const bool is_hidden = isHidden(replanner_->memory(), situation_.pose, goal_, parameters_.goal_in_sight);
    return is_hidden ? GoalSeems::kInObstacle : GoalSeems::kEnclosed;
  }
  if (endsBesideGoal()) return GoalSeems::kInObstacle;
  if (!decision_.on_route) return GoalSeems::kReachable;
  const Point2 here{situation_.pose.x, situation_.pose.y};
  return replanner_->isGoalBehindObstacle(here, goal_, parameters_.goal_in_sight) ? GoalSeems::kBehindObstacle
                                                                                  : GoalSeems::kReachable;
}

bool NavigationAgent::chooseGoalInSight(const StepContext& step) {
  const double distance = distanceBetween(situation_.pose, decision_.destination);
  const double direction = directionTo(situation_.pose, decision_.destination);
  const bool is_in_view = std::abs(normalizeAngle(direction - situation_.pose.yaw)) <= M_PI_2;
  const double sight = std::min(parameters_.goal_in_sight, parameters_.shield.reach - shield_.footprintRadius());
  if (!parameters_.shield_enabled || distance > sight || !is_in_view) return false;
  if (step.freeDistance(direction, distance) < distance - 0.5 * parameters_.goal_tolerance) return false;
  step.goTo(Move::kGoalInSight, direction, distance);
  return true;
}

void NavigationAgent::decideAsLed(const StepContext& step, Answer answer) {
  if (decision_.leader == Leader::kEscape) {
    if (leadAlongBoundary(step, &bug_algorithm_)) return;
    startFrom(kNearerThanEver);
    answer = step.searchPath();
  }
  if (decision_.leader == Leader::kRoute) {
    leadAlongPath(step, answer);
  } else {
    leadByPreferences(step, answer);
  }
}

StepContext NavigationAgent::context() {
  return {parameters_,     policy_.description().actions,
          situation_,      shield_,
          goal_,           clock_.pose().yaw,
          driven_,         progress_.target(),
          imposed_action_, replanner_ ? &*replanner_ : nullptr,
          &bound_,         &look_around_turn_,
          &decision_};
}

}  // namespace lstm_planner
