#pragma once

#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/learning/grid_q_learning.hpp"

namespace lstm_planner {

/// R(s) as ThesisRewardWeights says.
double thesisReward(const GridMemory& memory, const ThesisRewardWeights& weights);

}  // namespace lstm_planner
