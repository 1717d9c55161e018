#include "lstm_planner/agent/agent_parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "lstm_planner/parameter_check.hpp"

namespace lstm_planner {

namespace {
constexpr std::array<const char*, 3> kLeaders = {"network", "route", "none"};
}  // namespace

const char* toString(Leader leader) { return kLeaders.at(static_cast<std::size_t>(leader)); }

Leader leaderNamed(const std::string& name) {
  const auto found = std::find(kLeaders.begin(), kLeaders.end(), name);
  if (found == kLeaders.end()) {
    throw std::invalid_argument("leader is '" + name + "', expected network, route or none");
  }
  return static_cast<Leader>(found - kLeaders.begin());
}

void validate(const AgentParameters& parameters) {
  if (parameters.leader == Leader::kRoute && !parameters.memory.enabled) {
    throw std::invalid_argument("leader is route, expected network where memory/enabled is false: no way is remembered");
  }
  checkPositive("step/length", parameters.step.length);
  checkPositive("step/turn", parameters.step.turn);
  checkPositive("step/period", parameters.step.period);
  checkPositive("step/reached", parameters.step.reached);
  checkParameter(parameters.step.stall > parameters.step.period, "step/stall", parameters.step.stall,
                 "more than step/period = " + std::to_string(parameters.step.period));
  checkPositive("step/still_distance", parameters.step.still_distance);
  checkPositive("step/still_turn", parameters.step.still_turn);

  const ShieldParameters& shield = parameters.shield;
  checkPositive("shield/footprint_radius", shield.footprint_radius);
  checkParameter(shield.tight_clearance >= 0.0, "shield/tight_clearance", shield.tight_clearance, "zero or more");
  checkParameter(shield.clearance >= shield.tight_clearance, "shield/clearance", shield.clearance,
                 "at least shield/tight_clearance = " + std::to_string(shield.tight_clearance));
  checkPositive("shield/shortest_step", shield.shortest_step);
  checkParameter(shield.shortest_step <= parameters.step.length, "shield/shortest_step", shield.shortest_step,
                 "at most step/length = " + std::to_string(parameters.step.length));
  checkParameter(parameters.step.reached < shield.shortest_step, "step/reached", parameters.step.reached,
                 "less than shield/shortest_step = " + std::to_string(shield.shortest_step));
  const double needed_reach = parameters.step.length + shield.footprint_radius + shield.clearance;
  checkParameter(shield.reach >= needed_reach, "shield/reach", shield.reach,
                 "at least step, footprint radius and clearance together = " + std::to_string(needed_reach));

  const MemoryParameters& memory = parameters.memory;
  checkPositive("memory/resolution", memory.resolution);
  const double coarsest = 0.29 * shield.footprint_radius;
  checkParameter(memory.resolution <= coarsest, "memory/resolution", memory.resolution,
                 "at most 0.29 shield/footprint_radius = " + std::to_string(coarsest));
  checkParameter(memory.width >= 4.0 && memory.width <= 2000.0 * memory.resolution, "memory/width", memory.width,
                 "at least 4 m and at most 2000 memory/resolution = " + std::to_string(2000.0 * memory.resolution));
  checkPositive("memory/reach", memory.reach);
  checkParameter(memory.comfort >= 0.0, "memory/comfort", memory.comfort, "zero or more");
  checkParameter(memory.tightness >= 1.0, "memory/tightness", memory.tightness, "1 or more");

  const EscapeParameters& escape = parameters.escape;
  checkParameter(escape.patience_steps > 0, "escape/patience_steps", escape.patience_steps, "a positive number");
  checkPositive("escape/patience_distance", escape.patience_distance);
  checkParameter(escape.last_resort >= 1.0, "escape/last_resort", escape.last_resort, "1 or more");
  checkPositive("escape/progress", escape.progress);
  checkPositive("escape/follow_step", escape.follow_step);
  checkParameter(escape.probe_angle > 0.0 && escape.probe_angle < M_PI_4, "escape/probe_angle", escape.probe_angle,
                 "between 0 and pi/4");
  checkParameter(escape.wall_turn > 0.0 && escape.wall_turn < M_PI, "escape/wall_turn", escape.wall_turn,
                 "between 0 and pi");
  checkPositive("escape/leave_margin", escape.leave_margin);
  checkPositive("escape/first_leg", escape.first_leg);
  checkPositive("escape/loop_tolerance", escape.loop_tolerance);
  checkPositive("escape/loop_length", escape.loop_length);

  checkPositive("goal_tolerance", parameters.goal_tolerance);
  checkParameter(parameters.step.reached < parameters.goal_tolerance, "step/reached", parameters.step.reached,
                 "less than goal_tolerance = " + std::to_string(parameters.goal_tolerance));
  checkParameter(parameters.goal_drift >= 0.0 && parameters.goal_drift < 1.0, "goal_drift", parameters.goal_drift,
                 "a share in [0, 1)");
  checkParameter(parameters.goal_in_sight >= 0.0, "goal_in_sight", parameters.goal_in_sight, "zero or more");
}

}  // namespace lstm_planner
