#include "lstm_planner/drive/decision/route_leader.hpp"

namespace lstm_planner {

namespace {

/// Places ahead that are taken as blocked, one after the other, before the robot looks around.
constexpr int kBlocks = 3;

}  // namespace

bool RouteLeader::decide(const StepContext& step, Replanner::Answer answer) {
  using Answer = Replanner::Answer;
  for (int blocks = 0; blocks <= kBlocks; ++blocks) {
    if (answer == Answer::kNoPath) {
      step.goTo(Decision::Move::kNoPath, step.situation.pose.yaw, 0.0);
      return true;
    }
    if (answer != Answer::kRoute) break;
    if (step.followPath(Leader::kRoute)) return true;
    step.replanner->blockAhead();
    answer = step.searchPath();
  }
  step.lookAround();
  return true;
}

}  // namespace lstm_planner
