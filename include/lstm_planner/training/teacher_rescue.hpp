#pragma once

#include <algorithm>
#include <limits>

namespace lstm_planner {

/// Lets the teacher lead for a while when a learner comes no nearer to its goal.
class TeacherRescue {
 public:
  /// After `stuck_steps` steps in which the distance to the goal was not less than the best one minus `nearer`, the
  /// teacher leads for `rescue_steps` steps.
  TeacherRescue(double nearer, int stuck_steps, int rescue_steps)
      : nearer_(nearer), stuck_steps_(stuck_steps), rescue_steps_(rescue_steps) {}

  /// To be called once for each step, with the distance to the goal: whether the teacher leads this step.
  bool wanted(double distance) {
    since_best_ = distance < best_ - nearer_ ? 0 : since_best_ + 1;
    best_ = std::min(best_, distance);
    if (since_best_ >= stuck_steps_) {
      since_best_ = 0;
      steps_left_ = rescue_steps_;
    }
    if (steps_left_ == 0) return false;
    --steps_left_;
    return true;
  }

 private:
  double nearer_;
  int stuck_steps_;
  int rescue_steps_;
  double best_ = std::numeric_limits<double>::infinity();
  int since_best_ = 0;
  int steps_left_ = 0;
};

}  // namespace lstm_planner
