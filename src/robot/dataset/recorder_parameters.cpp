#include "lstm_planner/robot/dataset/recorder_parameters.hpp"

#include <stdexcept>
#include <string>

#include "lstm_planner/base/common/parameter_check.hpp"
#include "lstm_planner/robot/driving/action_set.hpp"

namespace lstm_planner {

namespace {

/// Calls `visit(name, value)` for every number of the parameters, for both directions of the conversion.
template <typename Parameters, typename Visitor>
void visitNumbers(Parameters& parameters, Visitor visit) {
  visit("period", parameters.period);
  visit("min_step_distance", parameters.min_step_distance);
  visit("min_step_turn", parameters.min_step_turn);
  visit("max_gap", parameters.max_gap);
  visit("max_label_error", parameters.max_label_error);
  visit("range_cap", parameters.range_cap);
  visit("max_speed", parameters.max_speed);
  visit("least_measured", parameters.scan_rules.least_measured);
  visit("goal_tolerance", parameters.goal_tolerance);
  visit("delay", parameters.delay);
  visit("keep_scans", parameters.keep_scans);
  visit("action_angles", parameters.action_angles);
  visit("footprint_radius", parameters.agent.shield.footprint_radius);
  visit("step_length", parameters.agent.step.length);
  visit("memory_enabled", parameters.agent.memory.enabled);
  visit("memory_width", parameters.agent.memory.width);
  visit("memory_resolution", parameters.agent.memory.resolution);
  visit("memory_reach", parameters.agent.memory.reach);
  visit("goal_drift", parameters.agent.goal_drift);
}

}  // namespace

void validate(const RecorderParameters& parameters) {
  visitRecorderNumbers(parameters, RangeCheck());
  checkParameter(parameters.max_gap > parameters.period, "max_gap", parameters.max_gap,
                 "more than period = " + std::to_string(parameters.period));
  checkParameter(parameters.delay < parameters.max_gap, "delay", parameters.delay,
                 "less than max_gap = " + std::to_string(parameters.max_gap));
  validate(parameters.scan_rules);
  const ActionSet actions(parameters.action_angles);
  validate(parameters.agent);
}

nlohmann::json toJson(const RecorderParameters& parameters) {
  nlohmann::json json;
  visitNumbers(parameters, [&](const char* name, const auto& value) { json[name] = value; });
  json["no_return"] = noReturnText(parameters.scan_rules);
  return json;
}

RecorderParameters recorderParametersFromJson(const nlohmann::json& json) {
  if (!json.is_object()) {
    throw std::invalid_argument(std::string("the recorder's parameters are of type ") + json.type_name() +
                                ", expected an object");
  }
  RecorderParameters parameters;
  visitNumbers(parameters, [&](const char* name, auto& value) {
    if (json.contains(name)) json.at(name).get_to(value);
  });
  if (json.contains("no_return")) setNoReturn(json.at("no_return").get<std::string>(), &parameters.scan_rules);
  return parameters;
}

}  // namespace lstm_planner
