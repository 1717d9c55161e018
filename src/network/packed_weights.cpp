#include "network/packed_weights.hpp"

#include <cmath>
#include <limits>

namespace lstm_planner {
namespace {

using Eigen::Index;
using Eigen::MatrixXf;
using Eigen::VectorXf;

std::size_t roundedUp(std::size_t size, std::size_t unit) { return (size + unit - 1) / unit * unit; }

LayerMatrices matrices(const LstmLayer& layer, int) {
  enum Gate { kInput, kOutput, kForget, kCandidate };  // as LstmLayer has them
  const int cells = static_cast<int>(layer.recurrent.cols());
  const float candidate_factor = layer.candidate == Activation::kSigmoid ? 0.5f : 1.0f;
  return {{LayerKind::kLstm, layer.candidate, cells},
          {{kInput, 0.5f}, {kForget, 0.5f}, {kCandidate, candidate_factor}, {kOutput, 0.5f}},
          layer.bias,
          layer.recurrent,
          layer.input};
}
LayerMatrices matrices(const RecurrentLayer& layer, int) {
  const int units = static_cast<int>(layer.recurrent.cols());
  return {{LayerKind::kRecurrent, Activation::kTanh, units}, {{0, 1.0f}}, layer.bias, layer.recurrent, layer.input};
}
LayerMatrices matrices(const DenseLayer& layer, int) {
  const int outputs = static_cast<int>(layer.weights.rows());
  return {{LayerKind::kDense, layer.activation, outputs}, {{0, 1.0f}}, layer.bias, MatrixXf(), layer.weights};
}
LayerMatrices matrices(const SoftmaxLayer&, int inputs) {
  return {{LayerKind::kSoftmax, Activation::kIdentity, inputs}, {}, VectorXf(), MatrixXf(), MatrixXf()};
}

/// A matrix on its way into memory.
struct Item {
  MatrixXf matrix;
  const LayerMatrices* layer;
  const LayerKernel* kernel;
  PackedMatrix* packed;
  std::size_t offset;

  std::size_t blocks() const {
    const auto lanes = static_cast<std::size_t>(kernel->lanes);
    return roundedUp(static_cast<std::size_t>(layer->shape.units), lanes) / lanes;
  }
  std::size_t size() const {
    return layer->gates.size() * blocks() * static_cast<std::size_t>(kernel->lanes * matrix.cols());
  }
};

/// Denormal weights would only make products slow.
float packedWeight(float weight) { return std::abs(weight) < std::numeric_limits<float>::min() ? 0.0f : weight; }

void write(const Item& item, float* to) {
  const int units = item.layer->shape.units;
  const int lanes = item.kernel->lanes;
  int rest = static_cast<int>(item.blocks());
  for (int unit = 0; rest > 0;) {
    const int blocks = tileBlocks(rest, item.kernel->blocks_a_tile);
    for (int column = 0; column < item.packed->columns; ++column) {
      for (const PackedGate& gate : item.layer->gates) {
        for (int row = unit; row < unit + blocks * lanes; ++row) {
          *to++ = row < units ? packedWeight(item.matrix(gate.block * units + row, column) * gate.factor) : 0.0f;
        }
      }
    }
    unit += blocks * lanes;
    rest -= blocks;
  }
}

/// Gives each matrix its place; the result is the size of all, in floats.
std::size_t arrange(std::vector<Item>* items) {
  std::size_t end = 0;
  for (Item& item : *items) {
    item.packed->columns = static_cast<int>(item.matrix.cols());
    item.offset = end;
    end += roundedUp(item.size(), kFloatsALine);
  }
  return end;
}

}  // namespace

LayerMatrices layerMatrices(const Layer& layer, int inputs) {
  return std::visit([&](const auto& typed) { return matrices(typed, inputs); }, layer);
}

PackedWeights::PackedWeights(const std::vector<LayerMatrices>& layers, const std::vector<LayerKernel>& kernels)
    : layers_(layers.size()) {
  std::vector<Item> items;
  for (std::size_t index = 0; index < layers.size(); ++index) {
    const LayerMatrices& layer = layers[index];
    PackedLayer& packed = layers_[index];
    packed.shape = layer.shape;
    items.push_back({layer.bias, &layer, &kernels[index], &packed.bias, 0});
    items.push_back({layer.recurrent, &layer, &kernels[index], &packed.recurrent, 0});
    items.push_back({layer.input, &layer, &kernels[index], &packed.input, 0});
  }
  memory_.resize(arrange(&items) / kFloatsALine);
  auto* first = reinterpret_cast<float*>(memory_.data());
  for (const Item& item : items) {
    item.packed->weights = first + item.offset;
    write(item, first + item.offset);
  }
}

}  // namespace lstm_planner
