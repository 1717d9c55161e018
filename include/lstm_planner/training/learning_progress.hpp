#pragma once

#include <algorithm>

namespace lstm_planner {

/// How far a learner is, on which its optimisers' rates depend.
class LearningProgress {
 public:
  /// `updates`: number of updates in the whole training.
  explicit LearningProgress(int updates) : last_update_(updates) {}

  /// Share of the training that is done.
  double progress() const { return std::min(1.0, static_cast<double>(updates_) / last_update_); }
  int updates() const { return updates_; }
  double steps() const { return steps_; }  ///< of all updates

  /// To be called after an update with so many steps of the agents.
  void finishUpdate(double steps) {
    ++updates_;
    steps_ += steps;
  }

 protected:
  int updates_ = 0;
  double steps_ = 0.0;

 private:
  int last_update_;
};

}  // namespace lstm_planner
