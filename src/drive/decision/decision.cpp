#include "lstm_planner/drive/decision/decision.hpp"

#include <algorithm>
#include <utility>

namespace lstm_planner {

std::size_t indexOf(Decision::Choice choice) {
  return static_cast<std::size_t>(std::find(kChoices.begin(), kChoices.end(), choice) - kChoices.begin());
}

Decision inParentFrame(const Pose2& frame, Decision decision) {
  decision.waypoint = toParentFrame(frame, decision.waypoint);
  decision.destination = toParentFrame(frame, decision.destination);
  decision.direction = normalizeAngle(frame.yaw + decision.direction);
  decision.path_on = toParentFrame(frame, std::move(decision.path_on));
  return decision;
}

const char* toString(Decision::Choice choice) {
  switch (choice.move) {
    case Decision::Move::kStep:
      return toString(choice.by);
    case Decision::Move::kGoalInSight:
      return "goal in sight";
    case Decision::Move::kLookAround:
      return "look around";
    case Decision::Move::kArrived:
      return "arrived";
    case Decision::Move::kNoPath:
      return "no path";
  }
  return "unknown";
}

const char* toString(Decision::GoalSeems goal_seems) {
  switch (goal_seems) {
    case Decision::GoalSeems::kReachable:
      return "reachable";
    case Decision::GoalSeems::kInObstacle:
      return "in an obstacle";
    case Decision::GoalSeems::kBehindObstacle:
      return "behind an obstacle";
    case Decision::GoalSeems::kEnclosed:
      return "enclosed";
  }
  return "unknown";
}

}  // namespace lstm_planner
