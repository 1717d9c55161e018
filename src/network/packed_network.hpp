#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
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
  PackedNetwork(const LayerStack& layers, InstructionSet set) : PackedNetwork(allMatrices(layers, set), set) {}
  PackedNetwork(const PackedNetwork&) = delete;
  PackedNetwork& operator=(const PackedNetwork&) = delete;

  /// In floats, a multiple of a cache line. The hidden state comes first: each recurrent layer's outputs, then an
  /// LSTM's cell states. What follows is the sums that the next step starts with, and room for what layers hand on.
  std::size_t memorySize() const { return memory_size_; }
  std::size_t hiddenStateSize() const { return hidden_state_size_; }

  /// Makes of the memory `now` that of the next step. False when a weighted sum is not finite; `next` is then
  /// worthless. The result goes to `output`, the last layer's width long.
  ///
  /// A recurrent product needs nothing but what the layer put out in the last step. So it comes where the processor
  /// would otherwise wait for activations: those of the later recurrent layers behind the layer before them, and that
  /// of the first, for the step to come, behind the layer after it.
  bool step(const float* input, const float* now, float* next, float* output) const {
    const std::size_t last = layers_.size() - 1;
    for (std::size_t index = 0; index <= last; ++index) {
      const Layer& layer = layers_[index];
      const PackedLayer& packed = *layer.packed;
      // A first layer's input may be the output of the step before.
      LayerValues values = layer.values(input, now, next);
      if (index != first_recurrent_) values.sums = next + layer.sums;
      if (index == last && index > 0 && !remembers(packed)) values.output = output;
      if (!layer.kernel.advance(packed, values)) return false;
      input = values.output;

      if (index < last && index + 1 != first_recurrent_ && remembers(*layers_[index + 1].packed)) {
        makeRecurrentSums(layers_[index + 1], now, next);
      }
      if (index == std::min(first_recurrent_ + 1, last)) prepare(next);
    }
    if (input != output) std::copy_n(input, layers_[last].packed->shape.units, output);
    return true;
  }

  /// Completes a memory whose hidden state is given.
  void prepare(float* memory) const {
    if (first_recurrent_ < layers_.size()) makeRecurrentSums(layers_[first_recurrent_], memory, memory);
  }

 private:
  static std::size_t wholeLines(std::size_t floats) {
    return (floats + kFloatsALine - 1) / kFloatsALine * kFloatsALine;
  }

  static std::vector<LayerMatrices> allMatrices(const LayerStack& layers, InstructionSet set) {
    validateLayers(layers);
    const std::vector<InstructionSet>& runnable = runnableInstructionSets();
    if (std::find(runnable.begin(), runnable.end(), set) == runnable.end()) {
      throw std::invalid_argument(std::string("the network's kernels are to be those for ") + toString(set) +
                                  ", which this machine cannot run");
    }
    std::vector<LayerMatrices> matrices;
    int inputs = inputSize(layers);
    for (const lstm_planner::Layer& layer : layers) {
      matrices.push_back(layerMatrices(layer, inputs));
      inputs = matrices.back().shape.units;
    }
    return matrices;
  }

  static LayerKernel kernelOf(const LayerShape& shape, InstructionSet set) {
    switch (set) {
#if defined(__x86_64__)
      case InstructionSet::kAvx512:
        return layerKernelAvx512(shape);
      case InstructionSet::kAvx2:
        return layerKernelAvx2(shape);
#endif
      default:
        return layerKernelBaseline(shape);
    }
  }

  static std::vector<LayerKernel> allKernels(const std::vector<LayerMatrices>& layers, InstructionSet set) {
    std::vector<LayerKernel> kernels;
    for (const LayerMatrices& layer : layers) kernels.push_back(kernelOf(layer.shape, set));
    return kernels;
  }

  static bool remembers(const PackedLayer& layer) { return layer.recurrent.columns > 0; }

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

  PackedNetwork(const std::vector<LayerMatrices>& layers, InstructionSet set)
      : weights_(layers, allKernels(layers, set)), first_recurrent_(layers.size()) {
    for (std::size_t index = 0; index < layers.size(); ++index) {
      const PackedLayer& packed = weights_.layers()[index];
      layers_.push_back({kernelOf(packed.shape, set), &packed, hidden_state_size_, 0});
      if (!remembers(packed)) continue;
      first_recurrent_ = std::min(first_recurrent_, index);
      hidden_state_size_ +=
          static_cast<std::size_t>(packed.shape.kind == LayerKind::kLstm ? 2 * packed.shape.units : packed.shape.units);
    }
    memory_size_ = wholeLines(hidden_state_size_ + kMostLanes);
    for (Layer& layer : layers_) {
      const LayerShape& shape = layer.packed->shape;
      (remembers(*layer.packed) ? layer.sums : layer.output) = memory_size_;
      const std::size_t gates = shape.kind == LayerKind::kLstm ? 4 : 1;
      memory_size_ += gates * wholeLines(static_cast<std::size_t>(shape.units));
    }
  }
  void makeRecurrentSums(const Layer& layer, const float* memory, float* next) const {
    layer.kernel.recurrentSums(*layer.packed, memory + layer.output, next + layer.sums);
  }

  PackedWeights weights_;
  std::vector<Layer> layers_;
  std::size_t first_recurrent_;  ///< layers_.size() when there is none
  std::size_t hidden_state_size_ = 0;
  std::size_t memory_size_ = 0;
};

}  // namespace lstm_planner
