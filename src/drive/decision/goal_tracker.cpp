#include "lstm_planner/drive/decision/goal_tracker.hpp"

#include <cmath>
#include <stdexcept>

namespace lstm_planner {

bool sameGoal(const GoalInFrame& a, const GoalInFrame& b) {
  constexpr double kSamePosition = 1e-3;
  constexpr double kSameHeading = 1e-3;
  return a.frame == b.frame && distanceBetween(a.pose, b.pose) <= kSamePosition &&
         std::abs(normalizeAngle(a.pose.yaw - b.pose.yaw)) <= kSameHeading;
}

GoalTracker::GoalTracker(double patience) : patience_(patience) {
  if (!std::isfinite(patience) || patience <= 0.0) {
    throw std::invalid_argument("the goal tracker's patience is " + std::to_string(patience) +
                                " s, expected a positive number");
  }
}

void GoalTracker::announce(const GoalInFrame& goal) {
  driven_ = goal;
  starts_anew_ = true;
  candidate_.reset();
}

GoalTracker::Verdict GoalTracker::ask(const GoalInFrame& goal, double time) {
  if (driven_ && sameGoal(*driven_, goal)) {
    candidate_.reset();
    const bool starts_anew = starts_anew_;
    starts_anew_ = false;
    return starts_anew ? Verdict::kNewGoal : Verdict::kDriven;
  }
  if (!takesOver(goal, time)) {
    return Verdict::kQuestion;
  }
  driven_ = goal;
  starts_anew_ = false;
  candidate_.reset();
  return Verdict::kNewGoal;
}

bool GoalTracker::takesOver(const GoalInFrame& goal, double time) {
  // A clock that jumped back (simulation started anew) would make the wait endless.
  if (!candidate_ || !sameGoal(candidate_->goal, goal) || time < candidate_->first_asked) {
    candidate_ = Candidate{goal, time};
    return false;
  }
  return !driven_ || time - candidate_->first_asked >= patience_;
}

}  // namespace lstm_planner
