#include "lstm_planner/dataset/recorder_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "lstm_planner/common/parameter_visitors.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/drive/decision/action_set.hpp"

namespace lstm_planner {

namespace {

/// As a parameter is called where it is stored: memory_width for memory/width, footprint_radius for
/// shield/footprint_radius.
std::string storedName(std::string name) {
  const std::string shield = "shield/";
  if (name.compare(0, shield.size(), shield) == 0) name.erase(0, shield.size());
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

}  // namespace

void validate(const RecorderParameters& parameters) {
  visitRecorderParameters(parameters, RangeCheck());
  checkParameter(parameters.max_gap > parameters.period, "max_gap", parameters.max_gap,
                 "more than period = " + numberText(parameters.period));
  checkParameter(parameters.delay < parameters.max_gap, "delay", parameters.delay,
                 "less than max_gap = " + numberText(parameters.max_gap));
  validate(parameters.scan_rules);
  const ActionSet actions(parameters.action_angles);
  validate(parameters.agent);
}

bool isStep(const Pose2& from, const Pose2& to, const RecorderParameters& parameters) {
  const double turned = turnBetween(to, from);
  return distanceBetween(from, to) >= parameters.min_step_distance ||
         (parameters.min_step_turn > 0.0 && turned >= parameters.min_step_turn);
}

nlohmann::json toJson(const RecorderParameters& parameters) {
  nlohmann::json json;
  visitRecorderParameters(parameters, [&](const std::string& name, const auto& value, Range, const char*, const char*) {
    json[storedName(name)] = value;
  });
  return json;
}

RecorderParameters recorderParametersFromJson(const nlohmann::json& json) {
  if (!json.is_object()) {
    throw std::invalid_argument(std::string("the recorder's parameters are of type ") + json.type_name() +
                                ", expected an object");
  }
  RecorderParameters parameters;
  visitRecorderParameters(parameters, [&](const std::string& name, auto& value, Range, const char*, const char*) {
    if (json.contains(storedName(name))) json.at(storedName(name)).get_to(value);
  });
  // The smallest robots have less comfort than the default, which is not stored.
  parameters.agent = fittedToFootprint(parameters.agent);
  return parameters;
}

}  // namespace lstm_planner
