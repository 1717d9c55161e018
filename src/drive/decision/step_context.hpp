#pragma once

#include <optional>

#include "lstm_planner/common/detour_bound.hpp"
#include "lstm_planner/drive/collision/shield.hpp"
#include "lstm_planner/drive/decision/action_set.hpp"
#include "lstm_planner/drive/decision/agent_parameters.hpp"
#include "lstm_planner/drive/decision/decision.hpp"
#include "lstm_planner/drive/local_map/replanner.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner {

/// What is known when a step is decided, and where the decision is written. Angles and places are in the odometry
/// frame.
struct StepContext {
  const AgentParameters& parameters;
  const ActionSet& actions;
  const Situation& situation;
  const Shield& shield;  ///< shows the situation
  Point2 goal;
  double start_yaw;            ///< rad, heading where the step began: the steering angles are relative to it
  double driven;               ///< m since the goal was set
  double nearer_than;          ///< m, a distance to the goal that would be a new best one
  std::optional<int> imposed;  ///< an action that is to be taken if it is allowed
  Replanner* replanner;        ///< null where nothing is remembered
  DetourBound* bound;
  double* look_around_turn;  ///< sign of the turn while nothing is free; 0: it must be chosen
  Decision* decision;

  /// Takes in what is seen, and searches the path through what is remembered; kRoute where nothing is.
  Replanner::Answer searchPath() const;

  /// m that are free in a direction (rad), at most `limit`, with the tight clearance.
  double freeDistance(double direction, double limit) const;

  void goTo(Decision::Choice choice, double direction, double distance) const;
  /// One of the steering angles, as the leader decides.
  void takeAction(int action, double distance) const;
  /// Along the path through what is remembered, or beside it where its first metres are not free. False if nothing is.
  bool followPath(Decision::Choice choice) const;
  void lookAround() const;
};

}  // namespace lstm_planner
