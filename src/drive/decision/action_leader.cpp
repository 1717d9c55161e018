#include "lstm_planner/drive/decision/action_leader.hpp"

namespace lstm_planner {

namespace {

/// The action in whose direction the path through what is remembered leaves.
int actionAlongPath(const StepContext& step) {
  const Pose2& pose = step.situation.pose;
  const double bearing = step.replanner->bearingAhead({pose.x, pose.y, step.start_yaw}, step.parameters.step.length);
  return step.actions.nearest(bearing);
}

/// How much longer the path becomes by the action, m; the path behind it is written to the decision.
double regretOf(const StepContext& step, const ActionChoice::Action& action) {
  const Pose2& pose = step.situation.pose;
  const Point2 next = pointAlong(pose, step.start_yaw + step.actions.angle(action.index), action.free);
  return step.replanner->regretOf({pose.x, pose.y}, next, &step.decision->path_on);
}

}  // namespace

bool ActionLeader::decide(const StepContext& step, Replanner::Answer answer) {
  const std::optional<ActionChoice::Action> chosen = answer == Replanner::Answer::kRoute ? choose(step) : std::nullopt;
  if (!step.replanner) {
    chosen ? step.takeAction(chosen->index, chosen->free) : step.lookAround();
    return true;
  }
  if (!chosen) return route_.decide(step, answer);
  Decision& decision = *step.decision;
  decision.along_path = actionAlongPath(step);
  if (!step.imposed && chosen->index == decision.along_path && step.followPath(decision.leader)) {
    decision.action = chosen->index;
    return true;
  }
  decision.regret = regretOf(step, *chosen);
  if (!step.imposed && !step.bound->allows(decision.regret, step.driven)) {
    decision.overruled = Overruled::kByBound;
    return route_.decide(step, answer);
  }
  step.bound->choose(decision.regret);
  step.takeAction(chosen->index, chosen->free);
  return true;
}

std::optional<ActionChoice::Action> ActionLeader::choose(const StepContext& step) const {
  Decision& decision = *step.decision;
  const auto chosen = choice_.choose(step.actions, step.start_yaw, step.situation.pose.yaw, step.shield,
                                     decision.preferences, step.imposed, &decision.allowed);
  const bool is_preferred = chosen && (decision.preferred < 0 || chosen->index == decision.preferred);
  if (!is_preferred) decision.overruled = Overruled::kByShield;
  return chosen;
}

}  // namespace lstm_planner
