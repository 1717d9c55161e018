#pragma once

#include <cstddef>
#include <vector>

#include "lstm_planner/network/instruction_set.hpp"
#include "lstm_planner/network/layers.hpp"
#include "network/step_kernel.hpp"

namespace lstm_planner {

/// A cache line, so that a vector of them begins at one: a load that crosses two lines takes twice as long.
struct alignas(64) CacheLine {
  float values[16];
};

/// A network as its kernels read it: the weights in their order, what a step does in which order, and the plan of the
/// memory that a step works on. Never changes, and is shared by copies of a network.
class PackedNetwork {
 public:
  /// Throws std::invalid_argument when the layers do not fit together or the instruction set cannot run here.
  PackedNetwork(const LayerStack& layers, InstructionSet set);
  PackedNetwork(const PackedNetwork&) = delete;
  PackedNetwork& operator=(const PackedNetwork&) = delete;

  /// In floats. The hidden state comes first: each recurrent layer's outputs, then an LSTM's cell states. What follows
  /// is the sums that the next step begins with, and room for what layers hand on.
  std::size_t memorySize() const { return memory_size_; }
  std::size_t hiddenStateSize() const { return hidden_state_size_; }

  /// Makes of the memory `now` that of the next step. False when a weighted sum is not finite; `next` is then
  /// worthless. The result goes to `output`, the last layer's width long.
  bool step(const float* input, const float* now, float* next, float* output) const;

  /// What step() would have left behind, had it led to the hidden state in `memory`.
  void prepare(float* memory) const;

 private:
  struct Layer {
    PackedLayer packed;
    LayerKernel kernel;
    std::size_t output;  ///< where in the memory
    std::size_t cells;
    std::size_t sums;
    std::vector<CacheLine> weights;
  };

  bool advance(const Layer& layer, const float* input, const float* now, float* next, float* output) const;

  std::vector<Layer> layers_;
  std::size_t first_recurrent_ = 0;  ///< layers_.size() when there is none
  std::size_t hidden_state_size_ = 0;
  std::size_t memory_size_ = 0;
};

}  // namespace lstm_planner
