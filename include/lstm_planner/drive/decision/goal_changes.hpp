#pragma once

#include "lstm_planner/drive/decision/navigation_agent.hpp"

namespace lstm_planner {

/// Tells an agent what has become of its goal since the last decision.
class GoalChanges {
 public:
  /// Why the drive so far was forgotten.
  enum class Fresh {
    kNo,        ///< it was not
    kNewGoal,   ///< a goal was given, perhaps the same one again
    kJump,      ///< odometry or localisation jumped: what was seen is forgotten, too
    kGoalMoved  ///< the goal moved farther than localisation corrects while the odometry is sound
  };

  /// `goal`: where it is now, in the frame in which goals are given. `frame_of_goals`: as a pose in the agent's frame,
  /// now; the two differ where drift is corrected (DriftCorrection). A goal that was not moved stays where it is in the
  /// agent's frame. `is_new`: it was set since the last call. `jumps`: number of jumps of odometry or localisation so
  /// far. Throws std::invalid_argument for a goal out of reach of what the agent perceived last (checkGoal), and tells
  /// it nothing.
  Fresh tell(NavigationAgent* agent, const Pose2& goal, const Pose2& frame_of_goals, bool is_new, long jumps);

  /// The goal in the agent's frame.
  const Pose2& goal() const { return goal_; }

 private:
  Pose2 given_;          ///< the goal as it was given
  Pose2 goal_;           ///< agent's frame
  bool is_new_ = false;  ///< nothing was decided for it
  long jumps_ = 0;       ///< that were heard of
};

}  // namespace lstm_planner
