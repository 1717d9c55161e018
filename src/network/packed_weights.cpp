#include "network/packed_weights.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace lstm_planner {
namespace {

using Eigen::Index;
using Eigen::MatrixXf;
using Eigen::VectorXf;

/// Memory a page apart shares its places in the first level of the cache, on all machines that look these up while they
/// translate the address.
constexpr std::size_t kFloatsAPage = 4096 / sizeof(float);

std::size_t roundedUp(std::size_t size, std::size_t unit) { return (size + unit - 1) / unit * unit; }

/// Floats that stay in the first level of the cache, with an eighth left to what else a step needs.
std::size_t floatsInCache() {
  long bytes = 0;
#if defined(_SC_LEVEL1_DCACHE_SIZE)
  bytes = sysconf(_SC_LEVEL1_DCACHE_SIZE);
#endif
  if (bytes <= 0) bytes = 32 * 1024;
  return static_cast<std::size_t>(bytes) * 7 / 8 / sizeof(float);
}

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
  std::size_t columnSize() const { return layer->gates.size() * blocks() * static_cast<std::size_t>(kernel->lanes); }
  std::size_t size() const { return columnSize() * static_cast<std::size_t>(matrix.cols()); }
};

/// Denormal weights would only make products slow.
float packedWeight(float weight) { return std::abs(weight) < std::numeric_limits<float>::min() ? 0.0f : weight; }

void write(const Item& item, float* weights) {
  const int units = item.layer->shape.units;
  const int lanes = item.kernel->lanes;
  const auto gates = static_cast<int>(item.layer->gates.size());
  int rest = static_cast<int>(item.blocks());
  for (int unit = 0, vector = 0; rest > 0;) {
    const int blocks = tileBlocks(rest, item.kernel->blocks_a_tile);
    const int stride = item.packed->column_stride > 0 ? item.packed->column_stride : gates * blocks * lanes;
    for (int column = 0; column < item.packed->columns; ++column) {
      float* to = weights + vector * item.packed->vector_stride + column * stride;
      for (const PackedGate& gate : item.layer->gates) {
        for (int row = unit; row < unit + blocks * lanes; ++row) {
          *to++ = row < units ? packedWeight(item.matrix(gate.block * units + row, column) * gate.factor) : 0.0f;
        }
      }
    }
    unit += blocks * lanes;
    vector += blocks * gates;
    rest -= blocks;
  }
}

/// Gives each matrix its place and strides; the result is the size of all, in floats.
std::size_t arrange(std::vector<Item>* items) {
  std::size_t size = 0;
  for (const Item& item : *items) size += item.size();
  const std::size_t cache = floatsInCache();
  const bool exceeds_a_little = size > cache && size <= 2 * cache;

  std::vector<Item*> apart;
  std::size_t end = 0;
  for (Item& item : *items) {
    item.packed->columns = static_cast<int>(item.matrix.cols());
    if (exceeds_a_little && end + item.size() > cache && item.columnSize() <= kFloatsAPage / 4) {
      apart.push_back(&item);
      continue;
    }
    item.offset = end;
    item.packed->vector_stride = item.kernel->lanes * item.packed->columns;
    end += roundedUp(item.size(), kFloatsALine);
  }
  if (!apart.empty()) end = roundedUp(end, kFloatsAPage);
  for (Item* item : apart) {
    item->offset = end + kFloatsAPage - roundedUp(item->columnSize(), kFloatsALine);
    item->packed->vector_stride = item->kernel->lanes;
    item->packed->column_stride = static_cast<int>(kFloatsAPage);
    end += kFloatsAPage * static_cast<std::size_t>(item->packed->columns);
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
  const std::size_t size = arrange(&items);
  const bool has_pages =
      std::any_of(items.begin(), items.end(), [](const Item& item) { return item.packed->column_stride > 0; });
  memory_.resize(roundedUp(size + (has_pages ? kFloatsAPage : 0), kFloatsALine) / kFloatsALine);
  auto* first = reinterpret_cast<float*>(memory_.data());
  const auto address = reinterpret_cast<std::uintptr_t>(first) / sizeof(float);
  if (has_pages) first += roundedUp(address, kFloatsAPage) - address;
  for (const Item& item : items) {
    item.packed->weights = first + item.offset;
    write(item, first + item.offset);
  }
}

}  // namespace lstm_planner
