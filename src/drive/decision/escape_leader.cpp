#include "lstm_planner/drive/decision/escape_leader.hpp"

#include <algorithm>

namespace lstm_planner {

bool EscapeLeader::decide(const StepContext& step, Replanner::Answer) {
  Heading move;
  const auto go = [&](Decision::Choice choice) {
    step.goTo(choice, move.direction, std::max(move.distance, step.parameters.shield.shortest_step));
  };
  switch (bug_algorithm_.decide(step.situation, step.shield, step.goal, step.nearer_than, &move)) {
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
