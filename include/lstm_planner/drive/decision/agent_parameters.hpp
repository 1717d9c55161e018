#pragma once

#include <cmath>
#include <string>
#include <type_traits>

#include "lstm_planner/common/detour_bound.hpp"
#include "lstm_planner/common/footprint.hpp"
#include "lstm_planner/drive/decision/decision.hpp"

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

/// What the shield lets through.
struct ShieldParameters {
  double footprint_radius = 0.17425;
  std::string footprint = "";
  double clearance = 0.07;
  double tight_clearance = 0.03;
  double shortest_step = 0.15;
  double reach = 6.0;
};

/// What is remembered of the obstacles that were seen, and how paths through them are found.
struct MemoryParameters {
  bool enabled = true;
  double width = 70.4;
  double resolution = 0.05;
  double reach = 12.0;
  double comfort = 0.12;
  double tightness = 3.0;
};

/// The last resort without progress: boundary following with the doubling search.
struct EscapeParameters {
  bool enabled = true;
  int patience_steps = 40;
  double patience_distance = 8.0;
  double last_resort = 30.0;
  double progress = 0.25;
  double follow_step = 0.25;
  double probe_angle = 0.08727;
  double wall_turn = 1.7453;
  double leave_margin = 0.2;
  double first_leg = 24.0;
  double loop_tolerance = 0.4;
  double loop_length = 3.0;
};

/// The leaders' names among the parameters: "network", "route", and "none" for kGreedy.
std::string nameOfLeader(Decision::Source leader);
/// Throws std::invalid_argument with the names there are.
Decision::Source leaderNamed(const std::string& name);

/// All parameters of NavigationAgent.
struct AgentParameters {
  Decision::Source leader = Decision::Source::kNetwork;
  StepParameters step;
  ShieldParameters shield;
  DetourParameters detour;
  MemoryParameters memory;
  EscapeParameters escape;
  bool shield_enabled = true;
  double goal_tolerance = 0.15;
  double goal_in_sight = 1.5;
  double goal_drift = 0.03;
  bool arrive_beside_goal = true;
  int draw_after = 60;
};

/// Largest distance, in squares of the memory, at which an obstacle matters to the middle of the footprint: the time
/// of an update grows with the square of it.
constexpr double kMostNearSquares = 16.0;
constexpr double kMostSquaresASide = 2000.0;  ///< of the memory

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
  visit("goal_drift", agent.goal_drift, {0.0, 0.9}, "",
        "possible error of odometry (1.5 times the usual one), as a share of the driven distance: a goal that turns "
        "out to lie in or behind an obstacle counts as reached from that distance; larger searches less often for a "
        "path to the other side of a wall, and misses more goals that really are there; 0 if odometry is corrected by"
        " a localisation");
  visit("arrive_beside_goal", agent.arrive_beside_goal, {}, "",
        "whether a robot that stops in front of such a goal has arrived; false: it drives there all the same, then the "
        "planner says that it stopped beside the goal and makes no plan, so that move_base reports ABORTED");
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
        "a robot that stands still for longer than this looks around; a smaller value gives up tight passages sooner");
  visit("step/still_distance", step.still_distance, {1e-4, 1.0}, "m",
        "a robot that moves less than this, and turns less than step/still_turn, stands still");
  visit("step/still_turn", step.still_turn, {1e-4, M_PI}, "rad",
        "see step/still_distance; must be larger than the noise of the odometry");
  visit("shield/enabled", agent.shield_enabled, {}, "",
        "removes the actions that would hit a sensed obstacle; set false only in simulation");
  auto& shield = agent.shield;
  visit("shield/footprint_radius", shield.footprint_radius, {0.02, 5.0}, "m",
        "radius of the circle around all parts of the robot (half the Create 2's diameter); not used if "
        "shield/footprint is set");
  visit("shield/footprint", shield.footprint, {}, "m",
        "corners [[x, y], ...] of a robot that is not round, around the origin of its base frame; empty: it is round");
  visit("shield/clearance", shield.clearance, {0.0, 5.0}, "m",
        "distance kept between the footprint and every return if there is room; more drives more smoothly, less fits "
        "through narrower doors");
  visit("shield/tight_clearance", shield.tight_clearance, {0.0, 5.0}, "m",
        "distance kept if no path has shield/clearance; at least the controller's safety_margin");
  visit("shield/shortest_step", shield.shortest_step, {0.002, 5.0}, "m",
        "an action with less free space than this is removed");
  visit(
      "shield/reach", shield.reach, {0.1, 100.0}, "m",
      "returns farther away are ignored; a larger value takes more time, a smaller one follows boundaries for longer");
  auto& detour = agent.detour;
  visit("detour/allowance", detour.allowance, {0.0, 1e5}, "m",
        "detours that the network may make in a drive: the sum of what its steps cost more than the path through the "
        "remembered obstacles; more lets the network decide more often, on longer paths");
  visit("detour/share", detour.share, {0.0, 100.0}, "",
        "detours that the network may make in addition, as a share of the driven distance");
  auto& memory = agent.memory;
  visit("memory/enabled", memory.enabled, {}, "",
        "false: no obstacles are remembered: nothing limits the network's detours, and without progress the robot "
        "follows boundaries (escape)");
  visit("memory/resolution", memory.resolution, {0.005, 1.0}, "m",
        "side of a square of the memory; at most 0.29 footprint radii, or paths would lead through walls");
  visit("memory/width", memory.width, {4.0, 1000.0}, "m",
        "side of the square around the robot in which obstacles are remembered; larger finds longer paths, and takes "
        "more memory and time; at most 2000 times the resolution");
  visit("memory/reach", memory.reach, {0.1, 100.0}, "m",
        "returns farther away are not remembered: they are too far apart to be walls");
  visit("memory/comfort", memory.comfort, {0.0, 5.0}, "m",
        "distance that paths keep between the footprint and obstacles where there is room; more suits controllers that "
        "follow paths less exactly, and takes more time");
  visit("memory/tightness", memory.tightness, {1.0, 100.0}, "",
        "factor on the length of a path where there is less room than shield/clearance; a larger value prefers longer "
        "paths around tight places");
  auto& escape = agent.escape;
  visit("escape/enabled", escape.enabled, {}, "", "false: the robot may stay in a dead end forever");
  visit("escape/patience_steps", escape.patience_steps, {1, 1000000}, "",
        "steps without a new best distance to the goal, after which the robot follows boundaries; fewer leaves dead "
        "ends sooner, but also interrupts detours that lead on");
  visit("escape/patience_distance", escape.patience_distance, {0.1, 1e5}, "m",
        "distance driven without a new best distance, with the same effect");
  visit("escape/last_resort", escape.last_resort, {1.0, 1e6}, "",
        "where obstacles are remembered, this many times the patience");
  visit("escape/progress", escape.progress, {0.01, 100.0}, "m",
        "a distance to the goal is a new best one if it is shorter than all earlier ones by at least this");
  visit("escape/follow_step", escape.follow_step, {0.05, 5.0}, "m",
        "distance to the waypoint while a boundary is followed; shorter follows corners more closely, and slower");
  visit("escape/probe_angle", escape.probe_angle, {0.01, 0.78}, "rad",
        "angle between two probed directions (5 degrees)");
  visit("escape/wall_turn", escape.wall_turn, {0.01, 3.14}, "rad",
        "angle back towards the boundary at which the probing starts (100 degrees)");
  visit("escape/leave_margin", escape.leave_margin, {0.01, 100.0}, "m",
        "the robot leaves the boundary when it is nearer to the goal by this much than where it met the boundary");
  visit("escape/first_leg", escape.first_leg, {0.1, 1e5}, "m",
        "length of boundary after which the robot turns back for the first time; doubles each time; longer suits large "
        "obstacles");
  visit("escape/loop_tolerance", escape.loop_tolerance, {0.01, 100.0}, "m",
        "a loop is closed when the robot is nearer than this to where it met the boundary; must be more than the drift "
        "of the odometry");
  visit("escape/loop_length", escape.loop_length, {0.1, 1e5}, "m", "a loop that is shorter than this does not count");
}

/// Of the shield. Throws std::invalid_argument as footprintOf() for two parameters.
Footprint footprintOf(const ShieldParameters& shield);

/// How near (m) to the goal a robot that has driven so far (m) may have arrived: odometry may be wrong by goal_drift.
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
