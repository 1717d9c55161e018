#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lstm_planner {

// Checkpoints are files that somebody may have changed. Whatever prints, compares or reads JSON of another encoding
// calls itself once for each level of it, so that few bytes could overflow the stack.

/// Throws std::invalid_argument when the text is no JSON, or of more than 16 levels.
nlohmann::json checkpointJson(const std::string& text);
/// The same of bytes in CBOR.
nlohmann::json checkpointJson(const std::vector<std::uint8_t>& cbor);

/// Throws std::invalid_argument unless it is a whole number from `lowest` to `highest`.
std::int64_t wholeNumber(const nlohmann::json& json, std::int64_t lowest, std::int64_t highest);

}  // namespace lstm_planner
