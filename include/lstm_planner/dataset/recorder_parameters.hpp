#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/drive/decision/agent_parameters.hpp"
#include "lstm_planner/drive/perception/scan_rules.hpp"

namespace lstm_planner {

/// How a drive is cut into steps and labelled. They are stored with the recording.
struct RecorderParameters {
  double period = 0.5;
  double min_step_distance = 0.05;
  double min_step_turn = 0.7854;
  double max_gap = 2.0;
  double max_label_error = 0.3927;
  double range_cap = 6.0;
  double max_speed = 1.0;
  double goal_tolerance = 0.3;
  double delay = 0.3;
  bool keep_scans = true;
  std::vector<double> action_angles = {-1.5707963, -0.7853982, 0.0, 0.7853982, 1.5707963};
  ScanRules scan_rules;   ///< what the scanner's readings mean
  AgentParameters agent;  ///< what the network's inputs depend on: memory, footprint, step length
};

/// Visits every parameter; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitRecorderParameters(Parameters& recorder, const Visitor& visit) {
  visit("period", recorder.period, {1e-4, 3600.0}, "s", "from step to step (thesis 4.2: 2 Hz)");
  visit("min_step_distance", recorder.min_step_distance, {1e-4, 100.0}, "m",
        "a step is recorded only if the robot has moved this far since the last one");
  visit("min_step_turn", recorder.min_step_turn, {0.0, M_PI}, "rad",
        "or has turned this far in place; 0: turning in place gives no steps");
  visit("max_gap", recorder.max_gap, {0.001, 86400.0}, "s",
        "an episode ends if scan or odometry are missing for longer, or if the clock jumps by more");
  visit("max_label_error", recorder.max_label_error, {1e-4, M_PI}, "rad",
        "a step is not labelled if its driven angle differs by more than this from all allowed angles (half the "
        "distance between the thesis's angles)");
  visit("range_cap", recorder.range_cap, {0.01, 1000.0}, "m", "farther ranges count as this in the mean of a sector");
  visit("max_speed", recorder.max_speed, {0.01, 1000.0}, "m/s", "if odometry moves faster, it has jumped");
  visit("goal_tolerance", recorder.goal_tolerance, {0.001, 100.0}, "m",
        "nearer to the goal than this, the driver has arrived");
  visit("delay", recorder.delay, {0.0, 3600.0}, "s",
        "how long to wait for late messages before messages with later stamps are processed");
  visit("keep_scans", recorder.keep_scans, {}, "", "also stores the whole scans");
  visit("action_angles", recorder.action_angles, {}, "rad", "the possible labels of a step");
  visitScanRules(recorder.scan_rules, visit);
  visitAgentParameters(recorder.agent,
                       onlyNamed({"step/length", "shield/footprint_radius", "shield/footprint", "goal_drift",
                                  "memory/enabled", "memory/width", "memory/resolution", "memory/reach"},
                                 visit));
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const RecorderParameters& parameters);

/// Whether the robot has moved far enough from one pose to the other for a step.
bool isStep(const Pose2& from, const Pose2& to, const RecorderParameters& parameters);

/// For the description of a recording.
nlohmann::json toJson(const RecorderParameters& parameters);
/// What is missing keeps its default. Throws std::invalid_argument for something else than an object, and
/// nlohmann::json::exception for a value of a wrong type.
RecorderParameters recorderParametersFromJson(const nlohmann::json& json);

}  // namespace lstm_planner
