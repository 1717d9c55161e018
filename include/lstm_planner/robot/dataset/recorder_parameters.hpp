#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "lstm_planner/robot/driving/agent_parameters.hpp"
#include "lstm_planner/robot/perception/scan_rules.hpp"

namespace lstm_planner {

/// How driving is cut into steps and labelled. They are stored with what was recorded.
struct RecorderParameters {
  double period = 0.5;              ///< s between steps (thesis 4.2: 2 Hz)
  double min_step_distance = 0.05;  ///< m; the robot has moved since the last step when it went this far
  double min_step_turn = 0.7854;    ///< rad; ... or, unless 0, when it turned this far in place
  double max_gap = 2.0;             ///< s; silence of scan or odometry longer than this ends an episode
  double max_label_error = 0.3927;  ///< rad; a step whose driven angle is farther than this from the nearest allowed
                                    ///< angle is not labelled (half the distance between the thesis's angles)
  double range_cap = 6.0;           ///< m; farther ranges count as this when sectors are averaged
  double max_speed = 1.0;           ///< m/s; odometry that moves faster has jumped
  double goal_tolerance = 0.3;      ///< m; nearer to the goal than this is arrived
  double delay = 0.3;      ///< s; how long messages are waited for before those with later stamps are worked on
  bool keep_scans = true;  ///< whether whole scans are stored, too
  std::vector<double> action_angles = {-1.5707963, -0.7853982, 0.0, 0.7853982, 1.5707963};  ///< rad, the allowed angles
  ScanRules scan_rules;   ///< what the scanner's readings mean
  AgentParameters agent;  ///< of what is remembered for the network: memory, footprint, step length
};

/// Calls visit(name, value, least, most) for every number that is the recorder's own.
template <typename Parameters, typename Visitor>
void visitRecorderNumbers(Parameters& recorder, const Visitor& visit) {
  visit("period", recorder.period, 1e-4, 3600.0);
  visit("min_step_distance", recorder.min_step_distance, 1e-4, 100.0);
  visit("min_step_turn", recorder.min_step_turn, 0.0, M_PI);
  visit("max_gap", recorder.max_gap, 0.001, 86400.0);
  visit("max_label_error", recorder.max_label_error, 1e-4, M_PI);
  visit("range_cap", recorder.range_cap, 0.01, 1000.0);
  visit("max_speed", recorder.max_speed, 0.01, 1000.0);
  visit("goal_tolerance", recorder.goal_tolerance, 0.001, 100.0);
  visit("delay", recorder.delay, 0.0, 3600.0);
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const RecorderParameters& parameters);

/// For the description of a recording. Reading leaves what is missing at its default.
nlohmann::json toJson(const RecorderParameters& parameters);
RecorderParameters recorderParametersFromJson(const nlohmann::json& json);

}  // namespace lstm_planner
