#include "lstm_planner/drive/decision/goal_changes.hpp"

#include "lstm_planner/drive/perception/reach.hpp"

namespace lstm_planner {

namespace {

/// m; a goal that moves farther between two calls is another goal.
constexpr double kGoalShift = 0.25;

}  // namespace

GoalChanges::Fresh GoalChanges::tell(NavigationAgent* agent, const Point2& goal, bool is_new, long jumps) {
  is_new_ = is_new_ || is_new;
  checkGoal(agent->situation().pose, goal);
  const double shift = distanceBetween(agent->goal(), goal);
  const bool jumped = jumps != jumps_;
  Fresh fresh = Fresh::kNo;
  if (is_new_) {
    fresh = Fresh::kNewGoal;
  } else if (jumped) {
    fresh = Fresh::kJump;
  } else if (shift > kGoalShift) {
    fresh = Fresh::kGoalMoved;
  }
  if (fresh != Fresh::kNo) {
    agent->setGoal(goal);
  } else if (shift > 0.0) {
    agent->moveGoal(goal);
  }
  if (jumped) agent->restart();
  jumps_ = jumps;
  is_new_ = false;
  return fresh;
}

}  // namespace lstm_planner
