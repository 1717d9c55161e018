#include "lstm_planner/drive/decision/step_clock.hpp"

#include <cmath>

namespace lstm_planner {

bool isStepDriven(const StepParameters& step, const Pose2& start, const Pose2& pose, const Point2& waypoint) {
  return distanceBetween(start, pose) >= step.length || turnBetween(pose, start) >= step.turn ||
         distanceBetween(pose, waypoint) < step.reached;
}

void StepClock::start(const Situation& situation) {
  has_step_ = true;
  pose_ = situation.pose;
  time_ = situation.time;
  stall_pose_ = situation.pose;
  stall_time_ = situation.time;
  stalls_ = 0;
}

bool StepClock::isOver(const Situation& situation, const Point2& waypoint) const {
  return isStepDriven(parameters_, pose_, situation.pose, waypoint) ||
         (std::abs(situation.time - time_) >= parameters_.period && hasMoved(situation, pose_));
}

bool StepClock::isStalled(const Situation& situation) {
  if (hasMoved(situation, stall_pose_)) {
    stall_pose_ = situation.pose;
    stall_time_ = situation.time;
    stalls_ = 0;
  }
  if (std::abs(situation.time - stall_time_) < parameters_.stall) return false;
  stall_time_ = situation.time;
  ++stalls_;
  return true;
}

bool StepClock::hasMoved(const Situation& situation, const Pose2& since) const {
  return distanceBetween(since, situation.pose) >= parameters_.still_distance ||
         turnBetween(situation.pose, since) >= parameters_.still_turn;
}

}  // namespace lstm_planner
