#pragma once

#include <cmath>
#include <string>

namespace lstm_planner {

/// When a step of the agent is over and the network decides anew.
struct StepParameters {
  double length = 0.4;           ///< m to the waypoint; a step is over when the robot has moved that far
  double turn = 0.7854;          ///< rad; a step is over when the robot has turned that far
  double period = 0.5;           ///< s; after this long a step is over if the robot has moved at all (thesis: 2 Hz)
  double reached = 0.05;         ///< m; a step is over when the robot is this near to the waypoint
  double stall = 2.0;            ///< s; a robot that stands still this long under a decision looks around instead
  double still_distance = 0.02;  ///< m; less than this, and
  double still_turn = 0.05;      ///< rad; less than this: the robot has not moved
};

/// What the shield lets through.
struct ShieldParameters {
  double footprint_radius = 0.17425;  ///< m, half the Create 2's diameter
  double clearance = 0.07;            ///< m kept between the footprint and every return when there is room
  double tight_clearance = 0.03;      ///< m kept where there is no way with `clearance`
  double shortest_step = 0.15;        ///< m; an action with less free way than this is not allowed
  double reach = 6.0;                 ///< m; returns farther away are not looked at
};

/// What is remembered of the obstacles that were seen, and how ways through them are found.
struct MemoryParameters {
  bool enabled = true;
  double width = 70.4;       ///< m, side of the square around the robot in which obstacles are remembered
  double resolution = 0.05;  ///< m; at most 0.29 footprint radii, or ways would lead through walls
  double reach = 12.0;       ///< m; returns farther away are not remembered
  double comfort = 0.12;     ///< m kept between the footprint and obstacles by ways where there is room
  double tightness = 3.0;    ///< how many times its length a way counts where there is less room than shield/clearance
};

/// The way out when the network makes no progress: boundary following with the doubling search.
struct EscapeParameters {
  bool enabled = true;
  int patience_steps = 40;          ///< steps without a new best distance to the goal before the way through what is
                                    ///< remembered leads in the network's place
  double patience_distance = 8.0;   ///< m driven likewise
  double last_resort = 30.0;        ///< times that patience before boundaries are followed instead
  double progress = 0.25;           ///< m; nearer to the goal than ever by this much is a new best
  double follow_step = 0.25;        ///< m to the waypoint while following a boundary
  double probe_angle = 0.08727;     ///< rad between probed directions (5 degrees)
  double wall_turn = 1.7453;        ///< rad; how far back towards the boundary the probing starts (100 degrees)
  double leave_margin = 0.2;        ///< m nearer to the goal than where the boundary was met before it is left
  double first_leg = 24.0;          ///< m of boundary before the first turning back; doubles each time
  double loop_tolerance = 0.4;      ///< m; coming back this near to where the boundary was met closes the loop
  double loop_length = 3.0;         ///< m; a shorter loop than this is not believed
};

/// Who chooses the steps as long as there is progress.
enum class Leader {
  kNetwork,  ///< the network; without progress the way through what is remembered
  kRoute,    ///< always the way through what is remembered; no network is asked
  kNone      ///< the allowed steering angle nearest to the goal's bearing: what a network has to be better than
};
/// The planner's, where nobody says otherwise: as measured, paths are shorter behind the remembered path than behind the
/// network (models/README.md).
constexpr Leader kDefaultLeader = Leader::kRoute;
/// "network", "route", "none".
const char* toString(Leader leader);
/// Throws std::invalid_argument with the names there are.
Leader leaderNamed(const std::string& name);

/// All parameters of NavigationAgent.
struct AgentParameters {
  Leader leader = Leader::kNetwork;
  StepParameters step;
  ShieldParameters shield;
  MemoryParameters memory;
  EscapeParameters escape;
  bool shield_enabled = true;
  double goal_tolerance = 0.15;  ///< m; nearer than this is arrived
  double goal_in_sight = 1.5;    ///< m; a goal this near with a free straight way is driven to directly
  double goal_drift = 0.02;      ///< share of the way driven by which odometry may be wrong: a goal that turns out to
                                 ///< lie in, or behind, an obstacle counts as reached from that far away
};

/// Obstacles matter to the memory within so many of its squares of the middle of the footprint: what an update costs
/// grows with the square of it.
constexpr double kMostNearSquares = 16.0;
constexpr double kMostSquaresASide = 2000.0;  ///< of the memory

/// Calls visit(name, value, least, most) for every number. Lengths and times are those of robots from a toy to a car on
/// floors and yards; what drives the cost of an update is bounded such that it stays in milliseconds.
template <typename Parameters, typename Visitor>
void visitAgentNumbers(Parameters& agent, const Visitor& visit) {
  visit("goal_tolerance", agent.goal_tolerance, 0.01, 10.0);
  visit("goal_in_sight", agent.goal_in_sight, 0.0, 100.0);
  visit("goal_drift", agent.goal_drift, 0.0, 0.9);
  auto& step = agent.step;
  visit("step/length", step.length, 0.05, 5.0);
  visit("step/turn", step.turn, 0.01, 2.0 * M_PI);
  visit("step/period", step.period, 0.01, 60.0);
  visit("step/reached", step.reached, 0.001, 1.0);
  visit("step/stall", step.stall, 0.01, 600.0);
  visit("step/still_distance", step.still_distance, 1e-4, 1.0);
  visit("step/still_turn", step.still_turn, 1e-4, M_PI);
  auto& shield = agent.shield;
  visit("shield/footprint_radius", shield.footprint_radius, 0.02, 5.0);
  visit("shield/clearance", shield.clearance, 0.0, 5.0);
  visit("shield/tight_clearance", shield.tight_clearance, 0.0, 5.0);
  visit("shield/shortest_step", shield.shortest_step, 0.002, 5.0);
  visit("shield/reach", shield.reach, 0.1, 100.0);
  auto& memory = agent.memory;
  visit("memory/resolution", memory.resolution, 0.01, 1.0);
  visit("memory/width", memory.width, 4.0, 1000.0);
  visit("memory/reach", memory.reach, 0.1, 100.0);
  visit("memory/comfort", memory.comfort, 0.0, 5.0);
  visit("memory/tightness", memory.tightness, 1.0, 100.0);
  auto& escape = agent.escape;
  visit("escape/patience_steps", escape.patience_steps, 1, 1000000);
  visit("escape/patience_distance", escape.patience_distance, 0.1, 1e5);
  visit("escape/last_resort", escape.last_resort, 1.0, 1e6);
  visit("escape/progress", escape.progress, 0.01, 100.0);
  visit("escape/follow_step", escape.follow_step, 0.05, 5.0);
  visit("escape/probe_angle", escape.probe_angle, 0.01, 0.78);
  visit("escape/wall_turn", escape.wall_turn, 0.01, 3.14);
  visit("escape/leave_margin", escape.leave_margin, 0.01, 100.0);
  visit("escape/first_leg", escape.first_leg, 0.1, 1e5);
  visit("escape/loop_tolerance", escape.loop_tolerance, 0.01, 100.0);
  visit("escape/loop_length", escape.loop_length, 0.1, 1e5);
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const AgentParameters& parameters);

}  // namespace lstm_planner
