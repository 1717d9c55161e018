#include "network/packed_network.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace lstm_planner {
namespace {

using Eigen::Index;
using Eigen::MatrixXf;
using Eigen::VectorXf;

constexpr int kFloatsALine = sizeof(CacheLine) / sizeof(float);

StepActivation stepActivation(Activation activation) {
  switch (activation) {
    case Activation::kIdentity:
      return StepActivation::kIdentity;
    case Activation::kTanh:
      return StepActivation::kTanh;
    case Activation::kSigmoid:
      return StepActivation::kSigmoid;
    case Activation::kRelu:
      return StepActivation::kRelu;
  }
  return StepActivation::kIdentity;
}

LayerKernel layerKernel(const LayerShape& shape, InstructionSet set) {
  switch (set) {
#if defined(__x86_64__)
    case InstructionSet::kAvx512:
      return avx512LayerKernel(shape);
    case InstructionSet::kAvx2:
      return avx2LayerKernel(shape);
#endif
    default:
      return baselineLayerKernel(shape);
  }
}

/// A layer's matrices one above the other, `gates` of them, with the factor that each gate's sums are wanted with.
struct Matrices {
  LayerShape shape;
  std::vector<float> gate_factors;
  VectorXf bias;
  MatrixXf recurrent;
  MatrixXf input;
};

Matrices matrices(const LstmLayer& layer, int /*inputs*/) {
  const int cells = static_cast<int>(layer.recurrent.cols());
  const float candidate_factor = layer.candidate == Activation::kSigmoid ? 0.5f : 1.0f;
  return {{LayerKind::kLstm, stepActivation(layer.candidate), static_cast<int>(layer.input.cols()), cells},
          {0.5f, 0.5f, 0.5f, candidate_factor}, layer.bias, layer.recurrent, layer.input};
}
Matrices matrices(const RecurrentLayer& layer, int /*inputs*/) {
  const int units = static_cast<int>(layer.recurrent.cols());
  return {{LayerKind::kRecurrent, StepActivation::kTanh, static_cast<int>(layer.input.cols()), units},
          {1.0f}, layer.bias, layer.recurrent, layer.input};
}
Matrices matrices(const DenseLayer& layer, int /*inputs*/) {
  return {{LayerKind::kDense, stepActivation(layer.activation), static_cast<int>(layer.weights.cols()),
           static_cast<int>(layer.weights.rows())},
          {1.0f}, layer.bias, MatrixXf(), layer.weights};
}
Matrices matrices(const SoftmaxLayer&, int inputs) {
  return {{LayerKind::kSoftmax, StepActivation::kIdentity, inputs, inputs}, {}, VectorXf(), MatrixXf(), MatrixXf()};
}

/// Numbers of blocks of a layer's tiles.
std::vector<int> tiles(int units, const LayerKernel& kernel) {
  std::vector<int> tiles;
  for (int rest = (units + kernel.lanes - 1) / kernel.lanes; rest > 0; rest -= tiles.back()) {
    tiles.push_back(tileBlocks(rest, kernel.blocks_a_tile));
  }
  return tiles;
}

/// Denormal weights would only make products slow.
float packedWeight(float weight) { return std::abs(weight) < std::numeric_limits<float>::min() ? 0.0f : weight; }

/// Appends a matrix in the order that PackedLayer describes.
void pack(const MatrixXf& matrix, const Matrices& layer, const LayerKernel& kernel, std::vector<float>* packed) {
  const int units = layer.shape.units;
  int tile_unit = 0;
  for (const int blocks : tiles(units, kernel)) {
    for (Index column = 0; column < matrix.cols(); ++column) {
      for (std::size_t gate = 0; gate < layer.gate_factors.size(); ++gate) {
        for (int unit = tile_unit; unit < tile_unit + blocks * kernel.lanes; ++unit) {
          const Index row = static_cast<Index>(gate) * units + unit;
          packed->push_back(unit < units ? packedWeight(matrix(row, column) * layer.gate_factors[gate]) : 0.0f);
        }
      }
    }
    tile_unit += blocks * kernel.lanes;
  }
}

std::size_t roundedUp(std::size_t size) { return (size + kFloatsALine - 1) / kFloatsALine * kFloatsALine; }

std::size_t appendAligned(const MatrixXf& matrix, const Matrices& layer, const LayerKernel& kernel,
                          std::vector<float>* packed) {
  packed->resize(roundedUp(packed->size()));
  const std::size_t offset = packed->size();
  pack(matrix, layer, kernel, packed);
  return offset;
}

}  // namespace

PackedNetwork::PackedNetwork(const LayerStack& layers, InstructionSet set) {
  validateLayers(layers);
  const std::vector<InstructionSet>& runnable = runnableInstructionSets();
  if (std::find(runnable.begin(), runnable.end(), set) == runnable.end()) {
    throw std::invalid_argument(std::string("this machine cannot run the network's kernel for ") + toString(set));
  }
  first_recurrent_ = layers.size();
  int inputs = inputSize(layers);
  for (const lstm_planner::Layer& typed_layer : layers) {
    const Matrices layer = std::visit([&](const auto& typed) { return matrices(typed, inputs); }, typed_layer);
    const LayerShape& shape = layer.shape;
    const LayerKernel kernel = layerKernel(shape, set);
    std::vector<float> packed;
    const std::size_t bias = appendAligned(layer.bias, layer, kernel, &packed);
    const std::size_t recurrent = appendAligned(layer.recurrent, layer, kernel, &packed);
    const std::size_t input = appendAligned(layer.input, layer, kernel, &packed);

    Layer& added = layers_.emplace_back();
    added.kernel = kernel;
    added.weights.resize(roundedUp(packed.size()) / kFloatsALine);
    float* weights = added.weights.empty() ? nullptr : added.weights.front().values;
    std::copy(packed.begin(), packed.end(), weights);
    added.packed = {shape, weights + bias, layer.recurrent.size() > 0 ? weights + recurrent : nullptr, weights + input};
    if (added.packed.recurrent != nullptr) {
      if (first_recurrent_ == layers.size()) first_recurrent_ = layers_.size() - 1;
      added.output = hidden_state_size_;
      added.cells = added.output + static_cast<std::size_t>(shape.units);
      hidden_state_size_ += static_cast<std::size_t>(shape.kind == LayerKind::kLstm ? 2 * shape.units : shape.units);
    }
    inputs = shape.units;
  }
  memory_size_ = roundedUp(hidden_state_size_ + kMostLanes);
  for (Layer& layer : layers_) {
    const LayerShape& shape = layer.packed.shape;
    std::size_t* room = layer.packed.recurrent != nullptr ? &layer.sums : &layer.output;
    *room = memory_size_;
    const std::size_t gates = shape.kind == LayerKind::kLstm ? 4 : 1;
    memory_size_ += gates * roundedUp(static_cast<std::size_t>(shape.units));
  }
}

bool PackedNetwork::advance(const Layer& layer, const float* input, const float* now, float* next,
                            float* output) const {
  const bool ahead = &layer == &layers_[first_recurrent_];
  const LayerValues values = {input, (ahead ? now : next) + layer.sums, now + layer.cells, next + layer.cells, output};
  return layer.kernel.advance(layer.packed, values);
}

/// What does not wait for the layer before goes between two that do, where the processor would otherwise be idle: the
/// recurrent sums of the later layers' step, and those of the first recurrent layer for the step to come.
bool PackedNetwork::step(const float* input, const float* now, float* next, float* output) const {
  const std::size_t last = layers_.size() - 1;
  for (std::size_t index = 0; index <= last; ++index) {
    const Layer& layer = layers_[index];
    float* own_output = next + layer.output;
    float* layer_output = index == last && layer.packed.recurrent == nullptr ? output : own_output;
    if (!advance(layer, input, now, next, layer_output)) return false;
    input = layer_output;

    if (index < last && layers_[index + 1].packed.recurrent != nullptr && index + 1 != first_recurrent_) {
      const Layer& following = layers_[index + 1];
      following.kernel.recurrentSums(following.packed, now + following.output, next + following.sums);
    }
    if (index == std::min(first_recurrent_ + 1, last) && first_recurrent_ <= last) {
      const Layer& first = layers_[first_recurrent_];
      first.kernel.recurrentSums(first.packed, next + first.output, next + first.sums);
    }
  }
  if (layers_[last].packed.recurrent != nullptr) std::copy_n(input, layers_[last].packed.shape.units, output);
  return true;
}

void PackedNetwork::prepare(float* memory) const {
  if (first_recurrent_ == layers_.size()) return;
  const Layer& first = layers_[first_recurrent_];
  first.kernel.recurrentSums(first.packed, memory + first.output, memory + first.sums);
}

}  // namespace lstm_planner
