#pragma once

namespace lstm_planner {

/// A tile is a group of agents whose values lie side by side: its memory is rows of `lanes` numbers, a row a value.
constexpr int kBatchBlock = 4;  ///< weighted sums that are made together: the gates of a cell, or so many units

/// What becomes of the weighted sums of a layer.
enum class BatchFunction { kLstm, kLstmWithSigmoidCandidate, kIdentity, kTanh, kSigmoid, kRelu, kSoftmax };

/// A layer as the kernels read it. Rows count from the start of a tile's memory, weights from that of all weights.
struct BatchLayer {
  BatchFunction function;
  int inputs;     ///< how many rows come from the layer below
  int recurrent;  ///< how many of the layer's own last output; 0 for a layer that remembers nothing
  int outputs;
  int input_row[2];   ///< in steps of even and of odd number
  int output_row[2];  ///< the other one holds the last output
  int cell_row;       ///< an LSTM's cell states
  long weights;       ///< blocks of (inputs + recurrent) x kBatchBlock; an LSTM's cell i, o, f, candidate
  long bias;          ///< blocks of kBatchBlock
};

/// Advances the agents of one tile by a step; `parity` is the step's number modulo 2. Sums whose function is a sigmoid
/// come at half their size (sigmoid(x) = (1 + tanh(x / 2)) / 2, and the kernels compute the tanh).
using BatchStep = void (*)(const BatchLayer* layers, int layer_count, const float* weights, int parity, float* memory);

struct BatchTileKernel {
  int lanes;
  BatchStep step;
};

/// An instruction set's tiles, from the narrowest to the widest.
struct BatchKernels {
  int count;
  BatchTileKernel tiles[4];
};

extern const BatchKernels kBatchKernelsBaseline;
#if defined(__x86_64__)
extern const BatchKernels kBatchKernelsAvx2;
extern const BatchKernels kBatchKernelsAvx512;
#endif

}  // namespace lstm_planner
