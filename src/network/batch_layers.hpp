#pragma once

#include <vector>

#include "lstm_planner/network/layers.hpp"
#include "network/batch_kernel.hpp"

namespace lstm_planner {

/// No cell state gets beyond it, as it grows by at most 1 a step and single precision has no larger number to which 1
/// can be added.
constexpr float kLargestState = 16777216.0f;

/// A network as the kernels of BatchNetwork read it.
struct BatchLayers {
  std::vector<BatchLayer> layers;
  std::vector<float> weights;
  int rows = 0;  ///< of a tile's memory; the first ones are the input
  /// The rows of the hidden state that steps of even and of odd number find.
  std::vector<int> state_rows[2];
  float input_limit = 0.0f;  ///< inputs up to this size keep every weighted sum within the range of float
};

/// Throws std::invalid_argument when the layers do not fit together, or when their weights are so large that a weighted
/// sum can leave the range of float whatever the input is.
BatchLayers packBatchLayers(const LayerStack& layers);

}  // namespace lstm_planner
