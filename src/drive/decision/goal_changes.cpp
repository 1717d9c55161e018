#include "lstm_planner/drive/decision/goal_changes.hpp"

#include "lstm_planner/drive/perception/reach.hpp"

namespace lstm_planner {

GoalChanges::Fresh GoalChanges::tell(NavigationAgent* agent, const Pose2& goal, const Pose2& frame_of_goals,
                                     bool is_new, long jumps) {
  is_new_ = is_new_ || is_new;
  const Pose2 now = compose(frame_of_goals, goal);
  checkGoal(agent->situation().pose, {now.x, now.y});
  const double shift = distanceBetween(given_, goal);
  const bool is_moved = shift > 0.0 || given_.yaw != goal.yaw;
  const bool jumped = jumps != jumps_;
  Fresh fresh = Fresh::kNo;
  if (is_new_) {
    fresh = Fresh::kNewGoal;
  } else if (jumped) {
    fresh = Fresh::kJump;
  } else if (shift > kGoalShift) {
    fresh = Fresh::kGoalMoved;
  }
  if (fresh != Fresh::kNo || is_moved) goal_ = now;
  given_ = goal;
  if (fresh != Fresh::kNo) {
    agent->setGoal({goal_.x, goal_.y});
  } else if (is_moved) {
    agent->moveGoal({goal_.x, goal_.y});
  }
  if (jumped) agent->restart();
  jumps_ = jumps;
  is_new_ = false;
  return fresh;
}

}  // namespace lstm_planner
