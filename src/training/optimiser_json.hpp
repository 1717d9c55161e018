#pragma once

#include <climits>
#include <nlohmann/json.hpp>
#include <vector>

#include "lstm_planner/training/optimiser.hpp"
#include "training/checkpoint_json.hpp"

namespace lstm_planner {

// Parts of a learner's checkpoint. Reading throws nlohmann::json::exception or std::invalid_argument for what is
// missing or of another type.

inline nlohmann::json vectorToJson(const Eigen::VectorXf& values) {
  return std::vector<float>(values.data(), values.data() + values.size());
}

inline Eigen::VectorXf vectorFromJson(const nlohmann::json& json) {
  const auto values = json.get<std::vector<float>>();
  return Eigen::Map<const Eigen::VectorXf>(values.data(), static_cast<Eigen::Index>(values.size()));
}

inline nlohmann::json optimiserToJson(const Optimiser::State& state) {
  return {{"velocity", vectorToJson(state.velocity)},
          {"squared_average", vectorToJson(state.squared_average)},
          {"updates", state.updates}};
}

inline Optimiser::State optimiserFromJson(const nlohmann::json& json) {
  return {vectorFromJson(json.at("velocity")), vectorFromJson(json.at("squared_average")),
          wholeNumber(json.at("updates"), 0, LONG_MAX)};
}

}  // namespace lstm_planner
