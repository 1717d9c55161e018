#pragma once

#include <cstddef>
#include <vector>

#include "lstm_planner/network/instruction_set.hpp"
#include "lstm_planner/network/layers.hpp"
#include "network/packed_weights.hpp"
#include "network/step_kernel.hpp"

namespace lstm_planner {

/// A network as its kernels read it: packed weights, and the plan of the memory that a step works on. Never changes,
/// and is shared by copies of a network.
class PackedNetwork {
 public:
  /// Throws std::invalid_argument when the layers do not fit together or the instruction set cannot run here.
  PackedNetwork(const LayerStack& layers, InstructionSet set);
  PackedNetwork(const PackedNetwork&) = delete;
  PackedNetwork& operator=(const PackedNetwork&) = delete;

  /// In floats, a multiple of a cache line. The hidden state comes first: each recurrent layer's outputs, then an
  /// LSTM's cell states. What follows is the sums that the next step starts with, and room for what layers hand on.
  std::size_t memorySize() const { return memory_size_; }
  std::size_t hiddenStateSize() const { return hidden_state_size_; }

  /// Makes of the memory `now` that of the next step. False when a weighted sum is not finite; `next` is then
  /// worthless. The result goes to `output`, the last layer's width long.
  bool step(const float* input, const float* now, float* next, float* output) const;

  /// Completes a memory whose hidden state is given.
  void prepare(float* memory) const;

 private:
  struct Layer {
    LayerKernel kernel;
    const PackedLayer* packed;
    std::size_t output;  ///< where in the memory; cell states follow
    std::size_t sums;

    LayerValues values(const float* input, const float* now, float* next) const {
      const std::size_t cells = output + static_cast<std::size_t>(packed->shape.units);
      return {input, now + sums, now + cells, next + cells, next + output};
    }
  };

  PackedNetwork(const std::vector<LayerMatrices>& layers, InstructionSet set);
  void makeRecurrentSums(const Layer& layer, const float* memory, float* next) const;

  PackedWeights weights_;
  std::vector<Layer> layers_;
  std::size_t first_recurrent_;  ///< layers_.size() when there is none
  std::size_t hidden_state_size_ = 0;
  std::size_t memory_size_ = 0;
};

}  // namespace lstm_planner
