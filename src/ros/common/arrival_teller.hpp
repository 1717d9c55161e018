#pragma once

#include <string>

namespace lstm_planner {

/// A global planner that knows where its plan ends: nav_core has no word for an end that is not the goal.
class ArrivalTeller {
 public:
  virtual ~ArrivalTeller() = default;

  /// What is to be said of a robot that has reached the end of the plan, where this lies beside the goal, in or behind
  /// an obstacle; else empty. Callable from any thread.
  virtual std::string besideGoal() = 0;
};

}  // namespace lstm_planner
