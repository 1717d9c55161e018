#pragma once

#include "lstm_planner/network/activation.hpp"
#include "lstm_planner/network/instruction_set.hpp"

namespace lstm_planner {

// What a network's step is made of: a function a layer, compiled for each instruction set from one source. This header
// is seen by code for machines of different ages, so that whatever it defines must have internal linkage.

enum class LayerKind { kLstm, kRecurrent, kDense, kSoftmax };

struct LayerShape {
  LayerKind kind;
  Activation activation;  ///< of a dense layer, or of an LSTM's candidate (kTanh or kSigmoid)
  int units;              ///< cells of an LSTM, outputs of any layer
};

/// A matrix in the order in which it is read.
///
/// Units are taken together in blocks of as many as a vector has lanes, and blocks in tiles of as many as the registers
/// hold sums for. A tile's column is, for each gate (one, or an LSTM's four: input, forget, candidate, output), for
/// each block of the tile, one vector. Units beyond the last are zeros. The gates with a sigmoid come halved, as
/// sigmoid(x) = (1 + tanh(x / 2)) / 2.
struct PackedMatrix {
  const float* weights = nullptr;
  int columns = 0;
};

struct PackedLayer {
  LayerShape shape;
  PackedMatrix bias;       ///< of one column
  PackedMatrix recurrent;  ///< empty for a layer that remembers nothing
  PackedMatrix input;
};

/// Where a layer finds what it works on. Vectors of `units` values lie without gaps; what is read from them in whole
/// vectors may be followed by anything that is finite.
struct LayerValues {
  const float* input;  ///< one value for each column of the input weights; of a softmax, for each unit
  const float* sums;   ///< what recurrentSums() made; unused by a layer that remembers nothing
  const float* cells;  ///< an LSTM's cell states
  float* next_cells;
  float* output;
};

/// The functions for one layer, and the sizes that its weights are packed by.
struct LayerKernel {
  int lanes;          ///< units in a block
  int blocks_a_tile;  ///< see tileBlocks()

  /// sums = bias + recurrent * outputs: what a layer's next step needs of its last. There must be room for whole tiles.
  void (*recurrentSums)(const PackedLayer& layer, const float* outputs, float* sums);

  /// The rest of the step. False when a weighted sum or a cell state is not finite; what was written is then worthless.
  bool (*advance)(const PackedLayer& layer, const LayerValues& values);
};

/// The kernel for a layer, for each instruction set.
LayerKernel layerKernelBaseline(const LayerShape& shape);
#if defined(__x86_64__)
LayerKernel layerKernelAvx2(const LayerShape& shape);
LayerKernel layerKernelAvx512(const LayerShape& shape);
#endif

/// Blocks in the next tile when `rest` blocks are left: a_tile (a power of two) while there are as many, then less.
static constexpr int tileBlocks(int rest, int a_tile) {
  while (a_tile > rest) a_tile /= 2;
  return a_tile;
}

/// A step reads whole vectors of at most so many floats.
static constexpr int kMostLanes = 16;

}  // namespace lstm_planner
