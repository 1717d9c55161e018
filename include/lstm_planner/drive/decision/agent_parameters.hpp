#pragma once

#include <cmath>
#include <string>
#include <type_traits>

#include "lstm_planner/common/detour_bound.hpp"
#include "lstm_planner/drive/collision/shield_parameters.hpp"
#include "lstm_planner/drive/decision/escape_parameters.hpp"
#include "lstm_planner/drive/decision/leader.hpp"
#include "lstm_planner/drive/local_map/memory_parameters.hpp"

namespace lstm_planner {

// What each parameter means, its unit and its range: visitAgentParameters().

/// When a step of the agent is over and the network decides again.
struct StepParameters {
  double length = 0.4;
  double turn = 0.7854;
  double period = 0.5;
  double reached = 0.05;
  double stall = 2.0;
  double still_distance = 0.02;
  double still_turn = 0.05;
};

/// All parameters of NavigationAgent.
struct AgentParameters {
  Leader leader = Leader::kNetwork;
  StepParameters step;
  ShieldParameters shield;
  DetourParameters detour;
  MemoryParameters memory;
  EscapeParameters escape;
  bool shield_enabled = true;
  double goal_tolerance = 0.15;
  double goal_in_sight = 1.5;
  bool correct_drift = true;
  double goal_drift = 0.01;
  bool arrive_beside_goal = true;
  int draw_after = 60;
};

/// Visits every parameter; see parameter_visitors.hpp. The ranges fit robots from the size of a toy to that of a car.
/// Parameters that determine the time of an update are limited so that it takes milliseconds.
template <typename Parameters, typename Visitor>
void visitAgentParameters(Parameters& agent, const Visitor& visit) {
  std::string leader = nameOfLeader(agent.leader);
  visit("leader", leader, {}, "",
        "who chooses the steps: network (detour/allowance and detour/share limit its detours), route (the path through "
        "the remembered obstacles) or none (the allowed angle nearest to the goal's bearing, with the same limit)");
  if constexpr (!std::is_const_v<Parameters>) agent.leader = leaderNamed(leader);
  visit("goal_tolerance", agent.goal_tolerance, {0.01, 10.0}, "m",
        "nearer to the goal than this the robot has arrived; not more than the controller's position_tolerance");
  visit("goal_in_sight", agent.goal_in_sight, {0.0, 100.0}, "m",
        "the robot drives straight to a goal that is nearer than this, if the straight path is free");
  visit(
      "correct_drift", agent.correct_drift, {}, "",
      "matches scans with earlier ones, so that neither obstacles nor the goal drift with the odometry; has no effect "
      "if the costmap's global frame is not that of the odometry, because a localisation corrects it then");
  visit("goal_drift", agent.goal_drift, {0.0, 0.9}, "",
        "only if memory/enabled is true: possible error of the robot's position (1.5 times the usual one), as a share "
        "of the driven distance: a goal that turns out to lie in or behind an obstacle counts as reached from that "
        "distance; larger searches less often for a path to the other side of a wall, and misses more goals that "
        "really are there; 0.03 if odometry is wrong by 2 % and correct_drift is false; 0 with a localisation");
  visit("arrive_beside_goal", agent.arrive_beside_goal, {}, "",
        "only if memory/enabled is true: whether a robot that stops in front of such a goal has arrived; false: it "
        "drives there all the same, then the planner says that it stopped beside the goal and makes no plan, so that "
        "move_base reports ABORTED");
  visit("draw_after", agent.draw_after, {0, 1000000}, "",
        "only if memory/enabled is false: steps without a new best distance to the goal, after which the network's "
        "steering angle is drawn with the probabilities that the network gives, as in training, so that the robot "
        "leaves circles; 0: the most probable angle always");
  auto& step = agent.step;
  visit("step/length", step.length, {0.05, 5.0}, "m",
        "distance to the waypoint; a step ends when the robot has moved this far; must be that of the model");
  visit("step/turn", step.turn, {0.01, 2.0 * M_PI}, "rad", "a step ends when the robot has turned this far");
  visit("step/period", step.period, {0.01, 60.0}, "s",
        "a step ends after this time if the robot has moved at all (thesis: 2 Hz)");
  visit("step/reached", step.reached, {0.001, 1.0}, "m", "a step ends when the robot is this near to the waypoint");
  visit("step/stall", step.stall, {0.01, 600.0}, "s",
        "a robot that stands still for longer than this tries another way, or looks around; a smaller value gives up "
        "tight passages sooner");
  visit("step/still_distance", step.still_distance, {1e-4, 1.0}, "m",
        "a robot that moves less than this, and turns less than step/still_turn, stands still");
  visit("step/still_turn", step.still_turn, {1e-4, M_PI}, "rad",
        "see step/still_distance; must be larger than the noise of the odometry");
  visit("shield/enabled", agent.shield_enabled, {}, "",
        "removes the actions that would hit a sensed obstacle; set false only in simulation");
  visitShieldParameters(agent.shield, visit);
  auto& detour = agent.detour;
  visit("detour/allowance", detour.allowance, {0.0, 1e5}, "m",
        "detours that the network may make in a drive: the sum of what its steps cost more than the path through the "
        "remembered obstacles; more lets the network decide more often, on longer paths");
  visit("detour/share", detour.share, {0.0, 100.0}, "",
        "detours that the network may make in addition, as a share of the driven distance");
  visitMemoryParameters(agent.memory, visit);
  visitEscapeParameters(agent.escape, visit);
}

/// How near (m) to the goal a robot that has driven so far (m) may have arrived: its position may be wrong by
/// goal_drift.
inline double toleranceAfter(double driven, const AgentParameters& parameters) {
  return parameters.goal_tolerance + parameters.goal_drift * driven;
}

/// The same parameters with memory/resolution, memory/width and, for the smallest robots, memory/comfort adapted to the
/// footprint, for robots of other sizes than that of the defaults. If no values fit, they stay as they are. For a
/// polygon the radius is the one that it needs to pass through a gap (Footprint::passingRadius()). Throws as
/// footprintOf().
AgentParameters fittedToFootprint(AgentParameters parameters);

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const AgentParameters& parameters);

}  // namespace lstm_planner
