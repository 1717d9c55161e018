#pragma once

#include <climits>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lstm_planner/training/optimiser.hpp"

namespace lstm_planner {

// Checkpoints are files that somebody may have changed. Whatever prints, compares or reads JSON of another encoding
// calls itself once for each level of it, so that few bytes could overflow the stack.

/// Throws std::invalid_argument when the text is no JSON, or of more than 16 levels.
nlohmann::json checkpointJson(const std::string& text);
/// The same of bytes in CBOR, which are to say that they have this `format`.
nlohmann::json checkpointJson(const std::vector<std::uint8_t>& cbor, const std::string& format);

/// Throws std::invalid_argument unless it is a whole number from `lowest` to `highest`.
std::int64_t wholeNumber(const nlohmann::json& json, std::int64_t lowest, std::int64_t highest);

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
