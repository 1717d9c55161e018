#include "drive/decision/step_leaders.hpp"

#include <algorithm>
#include <optional>

#include "lstm_planner/drive/decision/action_choice.hpp"

namespace lstm_planner {

namespace {

/// Places ahead that are taken as blocked, one after the other, before the robot looks around.
constexpr int kBlocks = 3;

std::optional<ChosenAction> chosenAction(const StepContext& step) {
  Decision& decision = *step.decision;
  const auto chosen = chooseAction(step.parameters, step.actions, step.start_yaw, step.situation.pose.yaw, step.shield,
                                   decision.preferences, step.imposed, &decision.allowed);
  const bool is_preferred = chosen && (decision.preferred < 0 || chosen->index == decision.preferred);
  if (!is_preferred) decision.overruled = Overruled::kByShield;
  return chosen;
}

/// The action in whose direction the path through what is remembered leaves.
int actionAlongPath(const StepContext& step) {
  const Pose2& pose = step.situation.pose;
  const double bearing = step.replanner->bearingAhead({pose.x, pose.y, step.start_yaw}, step.parameters.step.length);
  return step.actions.nearest(bearing);
}

/// How much longer the path becomes by the action, m; the path behind it is written to the decision.
double regretOf(const StepContext& step, const ChosenAction& action) {
  const Pose2& pose = step.situation.pose;
  const Point2 next = pointAlong(pose, step.start_yaw + step.actions.angle(action.index), action.free);
  return step.replanner->regretOf({pose.x, pose.y}, next, &step.decision->path_on);
}

}  // namespace

void leadByPreferences(const StepContext& step, Replanner::Answer answer) {
  const std::optional<ChosenAction> chosen = answer == Replanner::Answer::kRoute ? chosenAction(step) : std::nullopt;
  if (!step.replanner) {
    chosen ? step.takeAction(chosen->index, chosen->free) : step.lookAround();
    return;
  }
  if (!chosen) return leadAlongPath(step, answer);
  Decision& decision = *step.decision;
  decision.along_path = actionAlongPath(step);
  if (!step.imposed && chosen->index == decision.along_path && step.followPath(decision.leader)) {
    decision.action = chosen->index;
    return;
  }
  decision.regret = regretOf(step, *chosen);
  if (!step.imposed && !step.bound->allows(decision.regret, step.driven)) {
    decision.overruled = Overruled::kByBound;
    return leadAlongPath(step, answer);
  }
  step.bound->choose(decision.regret);
  step.takeAction(chosen->index, chosen->free);
}

void leadAlongPath(const StepContext& step, Replanner::Answer answer) {
  using Answer = Replanner::Answer;
  for (int blocks = 0; blocks <= kBlocks; ++blocks) {
    if (answer == Answer::kNoPath) return step.goTo(Decision::Move::kNoPath, step.situation.pose.yaw, 0.0);
    if (answer != Answer::kRoute) break;
    if (step.followPath(Leader::kRoute)) return;
    step.replanner->blockAhead();
    answer = step.searchPath();
  }
  step.lookAround();
}

bool leadAlongBoundary(const StepContext& step, BugAlgorithm* bug_algorithm) {
  Heading move;
  const auto go = [&](Decision::Choice choice) {
    step.goTo(choice, move.direction, std::max(move.distance, step.parameters.shield.shortest_step));
  };
  switch (bug_algorithm->decide(step.situation, step.shield, step.goal, step.nearer_than, &move)) {
    case BugAlgorithm::Answer::kGo:
      go(Leader::kEscape);
      break;
    case BugAlgorithm::Answer::kLookAround:
      go(Decision::Move::kLookAround);
      break;
    case BugAlgorithm::Answer::kNoPath:
      step.goTo(Decision::Move::kNoPath, step.situation.pose.yaw, 0.0);
      break;
    case BugAlgorithm::Answer::kNearer:
      return false;
  }
  return true;
}

}  // namespace lstm_planner
