#pragma once

#include "lstm_planner/drive/decision/bug_algorithm.hpp"
#include "lstm_planner/drive/decision/step_leader.hpp"

namespace lstm_planner {

/// The last resort: leads along boundaries until the robot is nearer to the goal than ever.
class EscapeLeader : public StepLeader {
 public:
  EscapeLeader(const EscapeParameters& parameters, const ShieldParameters& shield)
      : bug_algorithm_(parameters, shield) {}

  /// Starts from here.
  void start() { bug_algorithm_.start(); }
  /// As BugAlgorithm::moveGoal().
  void moveGoal(const Point2& from, const Point2& to) { bug_algorithm_.moveGoal(from, to); }

  bool decide(const StepContext& step, Replanner::Answer answer) override;

 private:
  BugAlgorithm bug_algorithm_;
};

}  // namespace lstm_planner
