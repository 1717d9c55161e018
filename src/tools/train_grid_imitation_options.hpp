#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lstm_planner/grid_world/learning/grid_imitation.hpp"
#include "tools/train_grid_options.hpp"

namespace lstm_planner {

/// Parses the options of --method imitation and dagger. False when the help was asked for. Throws with a sentence for
/// values that make no sense.
bool readImitationOptions(const std::string& method, const std::vector<std::string>& arguments,
                          GridTrainingOptions* options, GridImitationParameters* parameters, nlohmann::json* settings);

}  // namespace lstm_planner
