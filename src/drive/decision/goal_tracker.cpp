#include "lstm_planner/drive/decision/goal_tracker.hpp"

#include <cmath>
#include <stdexcept>

#include "lstm_planner/common/text_table.hpp"

namespace lstm_planner {

bool sameGoal(const GoalInFrame& a, const GoalInFrame& b) {
  constexpr double kSamePosition = 1e-3;
  constexpr double kSameHeading = 1e-3;
  return a.frame == b.frame && distanceBetween(a.pose, b.pose) <= kSamePosition &&
         std::abs(normalizeAngle(a.pose.yaw - b.pose.yaw)) <= kSameHeading;
}

GoalTracker::GoalTracker(double patience, bool announces_each_plan)
    : patience_(patience), announces_each_plan_(announces_each_plan) {
  if (!std::isfinite(patience) || patience <= 0.0) {
    throw std::invalid_argument("the goal tracker's patience is " + numberText(patience) +
                                " s, expected a positive number");
  }
}

void GoalTracker::announce(const GoalInFrame& goal) {
  hears_announcements_ = true;
  if (announces_each_plan_) {
    announced_ = goal;
    return;
  }
  driven_ = goal;
  starts_anew_ = true;
  candidate_.reset();
}

GoalTracker::Verdict GoalTracker::ask(const GoalInFrame& goal, double time) {
  const bool goes_on = isDriven(goal) && std::abs(time - asked_) <= patience_;
  if (announced_ && sameGoal(*announced_, goal) && !goes_on) {
    driven_ = goal;
    starts_anew_ = true;
  }
  announced_.reset();
  if (isDriven(goal)) {
    asked_ = time;
    candidate_.reset();
    const bool starts_anew = starts_anew_ || (is_given_up_ && !goes_on && !hears_announcements_);
    starts_anew_ = false;
    return starts_anew ? Verdict::kNewGoal : Verdict::kDriven;
  }
  if (!takesOver(goal, time)) {
    return Verdict::kQuestion;
  }
  driven_ = goal;
  asked_ = time;
  starts_anew_ = false;
  candidate_.reset();
  return Verdict::kNewGoal;
}

bool GoalTracker::takesOver(const GoalInFrame& goal, double time) {
  if (hears_announcements_) return false;
  // A clock that jumped back (simulation started anew) would make the wait endless.
  if (!candidate_ || !sameGoal(candidate_->goal, goal) || time < candidate_->first_asked) {
    candidate_ = Candidate{goal, time};
    return false;
  }
  return !driven_ || time - candidate_->first_asked >= patience_;
}

}  // namespace lstm_planner
