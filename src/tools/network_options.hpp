#pragma once

#include "lstm_planner/training/gradient.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "tools/command_line.hpp"

namespace lstm_planner {

/// The thesis's alternatives inside a layer, as options of each way of training.
void addActivationOptions(NetworkShape* shape, CommandLine* line);
void addLossOption(Loss* loss, CommandLine* line);

}  // namespace lstm_planner
