#pragma once

#include <vector>

#include "lstm_planner/training/gradient.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "tools/command_line.hpp"

namespace lstm_planner {

// Options of each way of training. `shape` and `loss` must stay where they are until the line is parsed.

/// Layers, and the thesis's alternatives inside a layer. `mlp_units`: of each layer of a perceptron, where nothing else
/// is said.
void addShapeOptions(NetworkShape* shape, const std::vector<int>& mlp_units, CommandLine* line);
void addLossOption(Loss* loss, CommandLine* line);

}  // namespace lstm_planner
