#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/overruled.hpp"
#include "lstm_planner/drive/decision/leader.hpp"

namespace lstm_planner {

/// One decision: who leads and why, what the robot does, and what the plan consists of. This record describes the whole
/// state of a drive to a goal; all of it is published.
struct Decision {
  /// What the robot does.
  enum class Move {
    kStep,         ///< what somebody decided who may lead
    kGoalInSight,  ///< goes straight to the goal: it is near, and the path free
    kLookAround,   ///< turns: nothing is free in sight, or all around must be seen
    kArrived,      ///< within the goal tolerance
    kNoPath        ///< the goal cannot be reached: no path through what was seen leads there
  };

  /// What the robot does, and if it is a step: who decided it.
  struct Choice {
    constexpr Choice(Leader leader) : by(leader) {}
    constexpr Choice(Move what) : move(what) {}

    Move move = Move::kStep;
    Leader by = Leader::kNetwork;  ///< the leader, or who overruled it
  };

  /// What the remembered obstacles say about the goal.
  enum class GoalSeems {
    kReachable,       ///< or not known yet
    kInObstacle,      ///< the path ends beside it; or it is near, an obstacle is before it, and no path is known
    kBehindObstacle,  ///< it is near, but the path to it is long: odometry may have moved it behind a wall
    kEnclosed         ///< no path is known; the robot looks around
  };

  Leader leader = Leader::kNetwork;  ///< who leads; another may decide in its place for the moment
  const char* why = "";              ///< it leads: a few words
  Choice choice = Move::kLookAround;
  Point2 waypoint;                 ///< odometry frame
  double direction = 0.0;          ///< rad, odometry frame, from where the decision was made to the waypoint
  int action = -1;                 ///< index of the steering angle; -1 when the waypoint is not one of them
  int preferred = -1;              ///< the network's answer: the action that it prefers of all, or that was drawn
                                   ///< by its preferences; -1 when it is not asked
  int along_path = -1;             ///< the action in whose direction the path through what is remembered leaves; -1
                                   ///< where none is known, and with a leader that does not ask for it
  std::vector<float> preferences;  ///< the network's, one an action
  std::vector<char> allowed;       ///< the shield's word, one an action
  bool on_route = false;           ///< the waypoint lies on, or beside, the path through what is remembered
  Overruled overruled = Overruled::kNo;
  double regret = 0.0;       ///< m by which the preferred, allowed action is longer than the remembered path; +inf:
                             ///< no path is known from its end
  double regret_used = 0.0;  ///< m, sum of the regrets that were carried out since the goal was set, this one included
  double regret_allowed = 0.0;  ///< m, the bound of that sum
  Point2 destination;           ///< where the plan ends: the goal, or where the footprint still fits when the goal
                                ///< lies in something (AgentParameters::goal_drift)
  std::vector<Point2> path_on;  ///< from the waypoint to the destination through what is remembered; empty where
                                ///< nothing is remembered, and where no such path was asked for
  GoalSeems goal_seems = GoalSeems::kReachable;
  long step = 0;  ///< counts the steps since the goal was set
};

constexpr bool operator==(const Decision::Choice& a, const Decision::Choice& b) {
  return a.move == b.move && (a.move != Decision::Move::kStep || a.by == b.by);
}
constexpr bool operator!=(const Decision::Choice& a, const Decision::Choice& b) { return !(a == b); }

/// Whether only a direction was decided, by one who does not look behind the waypoint.
inline bool isOneStep(const Decision& decision) {
  const bool is_by_action = decision.choice == Leader::kNetwork || decision.choice == Leader::kGreedy;
  return is_by_action && !decision.on_route;
}

/// The decision as it is seen in the frame in which `frame` is given.
Decision inParentFrame(const Pose2& frame, Decision decision);

/// Every choice there is.
constexpr std::array<Decision::Choice, 8> kChoices = {
    Leader::kNetwork,         Leader::kGreedy,        Decision::Move::kGoalInSight,
    Leader::kRoute,           Leader::kEscape,        Decision::Move::kLookAround,
    Decision::Move::kArrived, Decision::Move::kNoPath};
/// Its place among them.
std::size_t indexOf(Decision::Choice choice);

/// As toString(Leader), or "goal in sight", "look around", "arrived", "no path".
const char* toString(Decision::Choice choice);
/// "reachable", "in an obstacle", "behind an obstacle", "enclosed".
const char* toString(Decision::GoalSeems goal_seems);

}  // namespace lstm_planner
