#include "lstm_planner/drive/decision/goal_tracker.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/drive/perception/reach.hpp"

namespace lstm_planner {

bool sameGoal(const GoalInFrame& a, const GoalInFrame& b) {
  constexpr double kSamePosition = 1e-3;
  constexpr double kSameHeading = 1e-3;
  return a.frame == b.frame && distanceBetween(a.pose, b.pose) <= kSamePosition &&
         turnBetween(a.pose, b.pose) <= kSameHeading;
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
  } else {
    accept(goal);
  }
}

void GoalTracker::accept(const GoalInFrame& goal) {
  if (!goesOn() || goal.frame != began_.frame || distanceBetween(goal.pose, began_.pose) > kGoalShift) {
    start(goal);
    return;
  }
  if (change_ == Verdict::kDriven && !isDriven(goal)) change_ = Verdict::kMoved;
  driven_ = goal;
}

void GoalTracker::start(const GoalInFrame& goal) {
  driven_ = goal;
  began_ = goal;
  drive_of_driven_ = drive_;
  change_ = Verdict::kNewGoal;
}

GoalTracker::Verdict GoalTracker::ask(const GoalInFrame& goal, double time) {
  const bool is_asked_on = isDriven(goal) && std::abs(time - asked_) <= patience_;
  if (announced_ && sameGoal(*announced_, goal) && !is_asked_on) accept(goal);
  announced_.reset();
  const bool is_tried_again = isDriven(goal) && is_given_up_ && !is_asked_on && !goesOn();
  if (!hears_announcements_ && (is_tried_again || takesOver(goal, time))) start(goal);
  if (!isDriven(goal)) return Verdict::kQuestion;
  asked_ = time;
  candidate_.reset();
  return std::exchange(change_, Verdict::kDriven);
}

bool GoalTracker::takesOver(const GoalInFrame& goal, double time) {
  if (isDriven(goal)) return false;
  // A clock that jumped back (simulation started anew) would make the wait endless.
  if (!candidate_ || !sameGoal(candidate_->goal, goal) || time < candidate_->first_asked) {
    candidate_ = Candidate{goal, time};
    return false;
  }
  return !driven_ || time - candidate_->first_asked >= patience_;
}

}  // namespace lstm_planner
