#include "lstm_planner/drive/decision/decision.hpp"

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
    case Decision::Source::kNoPath:
      return "no path";
  }
  return "unknown";
}

const char* toString(Decision::Overruled overruled) {
  switch (overruled) {
    case Decision::Overruled::kNo:
      return "no";
    case Decision::Overruled::kByShield:
      return "by the shield";
    case Decision::Overruled::kByBound:
      return "by the bound";
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
