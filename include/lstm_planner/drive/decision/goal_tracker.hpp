#pragma once

#include <optional>
#include <string>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// A goal as it was given: a pose and the frame it is in.
struct GoalInFrame {
  std::string frame;
  Pose2 pose;
};

/// True for the same frame and the same pose to within a millimetre and a milliradian.
bool sameGoal(const GoalInFrame& a, const GoalInFrame& b);

/// Distinguishes the goal that the robot drives to from goals for which somebody only asks a plan.
///
/// nav_core does not announce a new goal, and makePlan() is also called for other goals (the make_plan service). Only
/// the goal that the robot drives to may advance the hidden state. There are two ways to
/// recognise it:
///  - an announcement: move_base publishes each goal that it accepts. An announced goal is always a new one, also at
///    the same pose. move_base_flex announces the goal before each plan, and then where the plan ends: there only a
///    goal counts that is asked for next, and it is new if nobody asked for it within `patience` s;
///  - where none was ever heard: a goal that is asked for again after `patience` s, while nobody asked for the driven
///    one, has taken its place. As long as there is no driven goal at all, the second question is enough.
/// Everything else is a question. Not thread safe.
class GoalTracker {
 public:
  /// What a goal is that a plan is asked for.
  enum class Verdict {
    kNewGoal,  ///< start driving to this goal: forget the last one
    kDriven,   ///< the goal being driven to, as before
    kQuestion  ///< another goal, nothing may be kept of it
  };

  /// `patience`: s, longer than the time between two calls for the driven goal. Throws std::invalid_argument unless it
  /// is finite and positive. `announces_each_plan`: as move_base_flex.
  explicit GoalTracker(double patience, bool announces_each_plan = false);

  /// The goal was accepted for driving.
  void announce(const GoalInFrame& goal);

  /// A plan for `goal` is asked for at `time` (s).
  Verdict ask(const GoalInFrame& goal, double time);

  /// Whether the drive to the driven goal has been given up. Where no goal is announced, who asks for it again after
  /// `patience` s hopes that the way has become free: it is new then. Who announces goals may only have paused, as
  /// move_base while the robot turns to recover.
  void setGivenUp(bool is_given_up) { is_given_up_ = is_given_up; }

 private:
  /// A goal that is asked for and not driven to.
  struct Candidate {
    GoalInFrame goal;
    double first_asked = 0.0;  ///< s
  };
  bool takesOver(const GoalInFrame& goal, double time);
  bool isDriven(const GoalInFrame& goal) const { return driven_ && sameGoal(*driven_, goal); }

  double patience_;
  bool announces_each_plan_;
  bool hears_announcements_ = false;
  std::optional<GoalInFrame> announced_;  ///< before the next plan, where each is announced
  double asked_ = 0.0;                    ///< s, when the driven goal was asked for last
  std::optional<GoalInFrame> driven_;
  bool starts_anew_ = false;  ///< announced, but not asked for since
  bool is_given_up_ = false;  ///< the drive to the driven goal
  std::optional<Candidate> candidate_;
};

}  // namespace lstm_planner
