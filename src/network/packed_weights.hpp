#pragma once

#include <Eigen/Core>
#include <vector>

#include "lstm_planner/network/layers.hpp"
#include "network/step_kernel.hpp"

namespace lstm_planner {

/// A cache line, so that a vector of them starts at one: a load that crosses two lines takes twice as long.
struct alignas(64) CacheLine {
  float values[16];
};
constexpr std::size_t kFloatsALine = sizeof(CacheLine) / sizeof(float);

struct PackedGate {
  int block;     ///< its place in the matrices, whose rows are the gates one above the other
  float factor;  ///< what its sums are wanted with
};

/// A layer as its kernel sees it, before it is packed.
struct LayerMatrices {
  LayerShape shape;
  std::vector<PackedGate> gates;  ///< in the order in which they are packed
  Eigen::VectorXf bias;
  Eigen::MatrixXf recurrent;  ///< empty for a layer that remembers nothing
  Eigen::MatrixXf input;
};

/// `inputs` is the width of what comes in, which a softmax does not know.
LayerMatrices layerMatrices(const Layer& layer, int inputs);

/// All layers' weights in one block of memory.
class PackedWeights {
 public:
  /// `kernels` has one for each layer.
  PackedWeights(const std::vector<LayerMatrices>& layers, const std::vector<LayerKernel>& kernels);

  /// Valid as long as this object is.
  const std::vector<PackedLayer>& layers() const { return layers_; }

 private:
  std::vector<CacheLine> memory_;
  std::vector<PackedLayer> layers_;
};

}  // namespace lstm_planner
