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

/// Distinguishes the goal that the robot drives to from goals for which somebody only asks a plan, and a new goal from
/// one that is given again.
///
/// nav_core does not announce a new goal, and makePlan() is also called for other goals (the make_plan service). Only
/// the goal that the robot drives to may advance the hidden state. What is heard of the executor tells them apart:
///  - announcements: move_base publishes each goal that it accepts, and drives to no other one. move_base_flex
///    announces the goal before each plan, and then where the plan ends: there only a goal counts that is asked for
///    next, and that nobody asked for within `patience` s;
///  - drives: as long as one goes on, an announced goal that lies within kGoalShift of where the driven one was when it
///    was new is the same goal. Exploration gives a goal anew whenever it has moved by a centimetre, and recovery
///    behaviours ask for no plan for as long as they take. Where no drive is heard of, each of these is a new goal;
///  - where nothing was ever announced: a goal that is asked for again after `patience` s, while nobody asked for the
///    driven one, has taken its place. As long as there is no driven goal at all, the second question is enough. And a
///    driven goal that was given up is new if nobody asked for it within `patience` s: the way may be free by now.
/// Everything else is a question. Not thread safe.
class GoalTracker {
 public:
  /// What a goal is that a plan is asked for.
  enum class Verdict {
    kNewGoal,  ///< start driving to this goal: forget the last one
    kMoved,    ///< the goal being driven to, given anew a little elsewhere
    kDriven,   ///< the goal being driven to, as before
    kQuestion  ///< another goal, nothing may be kept of it
  };

  /// `patience`: s, longer than the time between two calls for the driven goal. Throws std::invalid_argument unless it
  /// is finite and positive. `announces_each_plan`: as move_base_flex.
  explicit GoalTracker(double patience, bool announces_each_plan = false);

  /// The drive that goes on now, by the executor's own account; none: it says nothing. A drive goes on when another
  /// goal takes the place of its goal. Its number differs from that of each drive before.
  void setDrive(const std::optional<long>& drive) { drive_ = drive; }

  /// The goal was accepted for driving.
  void announce(const GoalInFrame& goal);

  /// A plan for `goal` is asked for at `time` (s).
  Verdict ask(const GoalInFrame& goal, double time);

  /// Whether the drive to the driven goal has been given up.
  void setGivenUp(bool is_given_up) { is_given_up_ = is_given_up; }

 private:
  /// A goal that is asked for and not driven to.
  struct Candidate {
    GoalInFrame goal;
    double first_asked = 0.0;  ///< s
  };
  void accept(const GoalInFrame& goal);
  void start(const GoalInFrame& goal);
  bool takesOver(const GoalInFrame& goal, double time);
  bool isDriven(const GoalInFrame& goal) const { return driven_ && sameGoal(*driven_, goal); }
  bool goesOn() const { return driven_ && drive_ && drive_ == drive_of_driven_; }

  double patience_;
  bool announces_each_plan_;
  bool hears_announcements_ = false;
  std::optional<GoalInFrame> announced_;  ///< before the next plan, where each is announced
  std::optional<long> drive_;
  double asked_ = 0.0;  ///< s, when the driven goal was asked for last
  std::optional<GoalInFrame> driven_;
  GoalInFrame began_;                    ///< the driven goal when it was new
  std::optional<long> drive_of_driven_;  ///< then
  Verdict change_ = Verdict::kDriven;    ///< of the driven goal, since it was asked for last
  bool is_given_up_ = false;             ///< the drive to the driven goal
  std::optional<Candidate> candidate_;
};

}  // namespace lstm_planner
