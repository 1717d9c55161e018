#pragma once

#include <map>
#include <string>

#include "lstm_planner/grid_world/agent/grid_agent.hpp"
#include "lstm_planner/network/layers.hpp"

namespace lstm_planner {

// The inputs of a network for the grid world (thesis 3.2), in their order: the eight ranges / 50; the goal's distance d
// (Euclidean, cells) as d / (d + 100); its angle / pi, in [-1, 1]; the previous move's direction / 4 - 1.

constexpr int kGridInputs = kGridRayCount + 3;

/// Writes input i to input[i * stride]. `previous_direction`: kNoPath before the first move, which gives 0. All inputs
/// are finite and in [-1, 1].
void encodeGrid(const GridObservation& observation, int previous_direction, float* input, int stride);

/// Writes the key grid_inputs, which says that a model has these inputs.
void writeGridMetadata(std::map<std::string, std::string>* metadata);
/// Throws std::invalid_argument for a model that was not made for the grid world, or has other inputs.
void checkGridMetadata(const std::map<std::string, std::string>& metadata);
/// Throws std::invalid_argument for a network without these inputs and an output for each of the eight moves.
void checkGridNetwork(const LayerStack& layers);

}  // namespace lstm_planner
