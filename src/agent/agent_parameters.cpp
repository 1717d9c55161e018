#include "lstm_planner/agent/agent_parameters.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace lstm_planner {

namespace {

void expect(bool holds, const std::string& name, double value, const std::string& expected) {
  if (!holds || !std::isfinite(value)) {
    throw std::invalid_argument("parameter " + name + " is " + std::to_string(value) + ", expected " + expected);
  }
}

void expectPositive(const std::string& name, double value) { expect(value > 0.0, name, value, "a positive number"); }

}  // namespace

void validate(const AgentParameters& parameters) {
  expectPositive("step/length", parameters.step.length);
  expectPositive("step/turn", parameters.step.turn);
  expectPositive("step/period", parameters.step.period);
  expectPositive("step/reached", parameters.step.reached);
  expect(parameters.step.stall > parameters.step.period, "step/stall", parameters.step.stall,
         "more than step/period = " + std::to_string(parameters.step.period));
  expectPositive("step/still_distance", parameters.step.still_distance);
  expectPositive("step/still_turn", parameters.step.still_turn);

  const ShieldParameters& shield = parameters.shield;
  expectPositive("shield/footprint_radius", shield.footprint_radius);
  expect(shield.tight_clearance >= 0.0, "shield/tight_clearance", shield.tight_clearance, "zero or more");
  expect(shield.clearance >= shield.tight_clearance, "shield/clearance", shield.clearance,
         "at least shield/tight_clearance = " + std::to_string(shield.tight_clearance));
  expectPositive("shield/shortest_step", shield.shortest_step);
  expect(shield.shortest_step <= parameters.step.length, "shield/shortest_step", shield.shortest_step,
         "at most step/length = " + std::to_string(parameters.step.length));
  expect(parameters.step.reached < shield.shortest_step, "step/reached", parameters.step.reached,
         "less than shield/shortest_step = " + std::to_string(shield.shortest_step));
  const double needed_reach = parameters.step.length + shield.footprint_radius + shield.clearance;
  expect(shield.reach >= needed_reach, "shield/reach", shield.reach,
         "at least step, footprint radius and clearance together = " + std::to_string(needed_reach));

  const EscapeParameters& escape = parameters.escape;
  expect(escape.patience_steps > 0, "escape/patience_steps", escape.patience_steps, "a positive number");
  expectPositive("escape/patience_distance", escape.patience_distance);
  expectPositive("escape/progress", escape.progress);
  expectPositive("escape/follow_step", escape.follow_step);
  expect(escape.probe_angle > 0.0 && escape.probe_angle < M_PI_4, "escape/probe_angle", escape.probe_angle,
         "between 0 and pi/4");
  expect(escape.wall_turn > 0.0 && escape.wall_turn < M_PI, "escape/wall_turn", escape.wall_turn, "between 0 and pi");
  expectPositive("escape/leave_margin", escape.leave_margin);
  expectPositive("escape/first_leg", escape.first_leg);
  expectPositive("escape/loop_tolerance", escape.loop_tolerance);
  expectPositive("escape/loop_length", escape.loop_length);

  expectPositive("goal_tolerance", parameters.goal_tolerance);
  expect(parameters.step.reached < parameters.goal_tolerance, "step/reached", parameters.step.reached,
         "less than goal_tolerance = " + std::to_string(parameters.goal_tolerance));
  expect(parameters.goal_in_sight >= 0.0, "goal_in_sight", parameters.goal_in_sight, "zero or more");
}

}  // namespace lstm_planner
