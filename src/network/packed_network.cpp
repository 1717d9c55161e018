#include "network/packed_network.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace lstm_planner {
namespace {

std::size_t wholeLines(std::size_t floats) { return (floats + kFloatsALine - 1) / kFloatsALine * kFloatsALine; }

std::vector<LayerMatrices> allMatrices(const LayerStack& layers, InstructionSet set) {
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

LayerKernel kernelOf(const LayerShape& shape, InstructionSet set) {
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

std::vector<LayerKernel> allKernels(const std::vector<LayerMatrices>& layers, InstructionSet set) {
  std::vector<LayerKernel> kernels;
  for (const LayerMatrices& layer : layers) kernels.push_back(kernelOf(layer.shape, set));
  return kernels;
}

bool remembers(const PackedLayer& layer) { return layer.recurrent.columns > 0; }

}  // namespace

PackedNetwork::PackedNetwork(const LayerStack& layers, InstructionSet set)
    : PackedNetwork(allMatrices(layers, set), set) {}

PackedNetwork::PackedNetwork(const std::vector<LayerMatrices>& layers, InstructionSet set)
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

void PackedNetwork::makeRecurrentSums(const Layer& layer, const float* memory, float* next) const {
  layer.kernel.recurrentSums(*layer.packed, memory + layer.output, next + layer.sums);
}

/// A recurrent product needs nothing but what the layer put out in the last step. So it comes where the processor would
/// otherwise wait for activations: those of the later recurrent layers behind the layer before them, and that of the
/// first, for the step to come, behind the layer after it.
bool PackedNetwork::step(const float* input, const float* now, float* next, float* output) const {
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

void PackedNetwork::prepare(float* memory) const {
  if (first_recurrent_ < layers_.size()) makeRecurrentSums(layers_[first_recurrent_], memory, memory);
}

}  // namespace lstm_planner
