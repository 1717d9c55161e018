// Included once by each batch_kernel_*.cpp, which are compiled for different instruction sets. Only the table at the
// end may have external linkage (see simd.hpp).

#include "network/batch_kernel.hpp"
#include "network/network_functions.hpp"

namespace lstm_planner {
namespace {

using simd::broadcast;
using simd::Fraction;
using simd::load;
using simd::multiplyAdd;
using simd::store;

#define LSTM_PLANNER_UNROLL _Pragma("GCC unroll 16")

/// kVectors vectors side by side are a row; kBlocks blocks are summed at a time, so that enough sums are under way to
/// hide how long a multiply-add takes, and few enough to stay in the registers. kTogether vectors go through a cell's
/// functions side by side.
template <class V, int kVectors, int kBlocks, int kTogether>
struct Tile {
  static constexpr int kVectorLanes = simd::kLanesOf<V>;
  static constexpr int kLanes = kVectors * kVectorLanes;

  template <int kCount>
  struct Sums {
    V of[kCount][kBatchBlock][kVectors];
  };

  template <int kCount>
  LSTM_PLANNER_INLINE static void accumulate(const float* weights, long block_stride, const float* rows, int row_count,
                                             Sums<kCount>* sums) {
    for (int row = 0; row < row_count; ++row, rows += kLanes, weights += kBatchBlock) {
      V values[kVectors];
      for (int v = 0; v < kVectors; ++v) values[v] = load<V>(rows + v * kVectorLanes);
      for (int block = 0; block < kCount; ++block) {
        for (int i = 0; i < kBatchBlock; ++i) {
          const V weight = broadcast<V>(weights[block * block_stride + i]);
          for (int v = 0; v < kVectors; ++v) {
            sums->of[block][i][v] = multiplyAdd(weight, values[v], sums->of[block][i][v]);
          }
        }
      }
    }
  }

  /// The weighted sums of kCount blocks of a layer, from `block` on.
  template <int kCount>
  LSTM_PLANNER_INLINE static void weigh(const BatchLayer& layer, const float* weights, int parity, int block,
                                        const float* memory, Sums<kCount>* sums) {
    const int row_count = layer.inputs + layer.recurrent;
    const long block_stride = static_cast<long>(row_count) * kBatchBlock;
    const float* const bias = weights + layer.bias + static_cast<long>(block) * kBatchBlock;
    for (int i = 0; i < kCount * kBatchBlock; ++i) {
      for (int v = 0; v < kVectors; ++v) sums->of[i / kBatchBlock][i % kBatchBlock][v] = broadcast<V>(bias[i]);
    }
    const float* const first = weights + layer.weights + block * block_stride;
    accumulate<kCount>(first, block_stride, row(memory, layer.input_row[parity]), layer.inputs, sums);
    accumulate<kCount>(first + static_cast<long>(layer.inputs) * kBatchBlock, block_stride,
                       row(memory, layer.output_row[1 - parity]), layer.recurrent, sums);
  }

  LSTM_PLANNER_INLINE static const float* row(const float* memory, int index) {
    return memory + static_cast<long>(index) * kLanes;
  }
  LSTM_PLANNER_INLINE static float* row(float* memory, int index) { return memory + static_cast<long>(index) * kLanes; }

  /// s' = f s + i c, h = tanh(s') o. The forget gate has a division of its own, so that a gate that is wide open keeps
  /// every bit of the cell state; the products of two fractions share one.
  template <bool kSigmoidCandidate, class G>
  LSTM_PLANNER_INLINE static G stepCells(const G (&sums)[kBatchBlock], G* states) {
    const Fraction<G> input_gate = simd::twiceSigmoidOfTwiceFraction(sums[0]);
    const Fraction<G> candidate =
        kSigmoidCandidate ? simd::twiceSigmoidOfTwiceFraction(sums[3]) : simd::tanhFraction(sums[3]);
    const G half = broadcast<G>(0.5f);
    const G scale = kSigmoidCandidate ? half * half : half;
    const G news =
        input_gate.numerator * candidate.numerator * scale / (input_gate.denominator * candidate.denominator);
    const G forget_gate = simd::value(simd::twiceSigmoidOfTwiceFraction(sums[2]));
    *states = multiplyAdd(forget_gate * half, *states, news);
    for (V& state : states->of) state = simd::flushTiny(state);
    const Fraction<G> output_gate = simd::twiceSigmoidOfTwiceFraction(sums[1]);
    const Fraction<G> squashed = simd::tanhFraction(*states);
    return squashed.numerator * output_gate.numerator * half / (squashed.denominator * output_gate.denominator);
  }

  template <bool kSigmoidCandidate, int kCount>
  LSTM_PLANNER_INLINE static void stepCellBlocks(const BatchLayer& layer, const float* weights, int parity, int block,
                                                 float* memory) {
    Sums<kCount> sums;
    weigh<kCount>(layer, weights, parity, block, memory, &sums);
    float* const states = row(memory, layer.cell_row + block);
    float* const outputs = row(memory, layer.output_row[parity] + block);
    constexpr int kGroup = kTogether < kCount * kVectors ? kTogether : kCount * kVectors;
    using G = simd::Group<V, kGroup>;
    LSTM_PLANNER_UNROLL
    for (int first = 0; first < kCount * kVectors; first += kGroup) {
      G gates[kBatchBlock];
      G cells;
      for (int i = 0; i < kGroup; ++i) {
        const int cell = (first + i) / kVectors;
        for (int gate = 0; gate < kBatchBlock; ++gate) {
          gates[gate].of[i] = sums.of[cell][gate][(first + i) % kVectors];
        }
        cells.of[i] = load<V>(states + (first + i) * kVectorLanes);
      }
      const G output = stepCells<kSigmoidCandidate>(gates, &cells);
      for (int i = 0; i < kGroup; ++i) store(cells.of[i], states + (first + i) * kVectorLanes);
      for (int i = 0; i < kGroup; ++i) store(output.of[i], outputs + (first + i) * kVectorLanes);
    }
  }

  template <bool kSigmoidCandidate>
  LSTM_PLANNER_INLINE static void stepLstm(const BatchLayer& layer, const float* weights, int parity, float* memory) {
    int cell = 0;
    for (; cell + kBlocks <= layer.outputs; cell += kBlocks) {
      stepCellBlocks<kSigmoidCandidate, kBlocks>(layer, weights, parity, cell, memory);
    }
    for (; cell < layer.outputs; ++cell) stepCellBlocks<kSigmoidCandidate, 1>(layer, weights, parity, cell, memory);
  }

  template <int kCount>
  LSTM_PLANNER_INLINE static void stepUnitBlocks(const BatchLayer& layer, const float* weights, int parity, int block,
                                                 float* memory) {
    Sums<kCount> sums;
    weigh<kCount>(layer, weights, parity, block, memory, &sums);
    for (int i = 0; i < kCount * kBatchBlock; ++i) {
      const int unit = block * kBatchBlock + i;
      if (unit >= layer.outputs) return;
      float* const outputs = row(memory, layer.output_row[parity] + unit);
      for (int v = 0; v < kVectors; ++v) {
        store(sums.of[i / kBatchBlock][i % kBatchBlock][v], outputs + v * kVectorLanes);
      }
    }
  }

  static V activation(BatchFunction function, V sum) {
    switch (function) {
      case BatchFunction::kTanh:
        return simd::flushTiny(simd::tanh(sum));  // a plain recurrent layer may fade out
      case BatchFunction::kSigmoid:
        return simd::value(simd::twiceSigmoidOfTwiceFraction(sum)) * broadcast<V>(0.5f);
      case BatchFunction::kRelu:
        return simd::maximum(sum, V{});
      default:
        return sum;
    }
  }

  LSTM_PLANNER_INLINE static void stepUnits(const BatchLayer& layer, const float* weights, int parity, float* memory) {
    const int blocks = (layer.outputs + kBatchBlock - 1) / kBatchBlock;
    int block = 0;
    for (; block + kBlocks <= blocks; block += kBlocks) {
      stepUnitBlocks<kBlocks>(layer, weights, parity, block, memory);
    }
    for (; block < blocks; ++block) stepUnitBlocks<1>(layer, weights, parity, block, memory);
    if (layer.function == BatchFunction::kIdentity) return;
    float* const outputs = row(memory, layer.output_row[parity]);
    for (int i = 0; i < layer.outputs * kLanes; i += kVectorLanes) {
      store(activation(layer.function, load<V>(outputs + i)), outputs + i);
    }
  }

  /// Probabilities are the same for preferences shifted by a constant; with the largest at 0 no exponential overflows.
  LSTM_PLANNER_INLINE static void stepSoftmax(const BatchLayer& layer, int parity, float* memory) {
    for (int v = 0; v < kVectors; ++v) {
      const float* const inputs = row(memory, layer.input_row[parity]) + v * kVectorLanes;
      float* const outputs = row(memory, layer.output_row[parity]) + v * kVectorLanes;
      V largest = load<V>(inputs);
      for (int i = 1; i < layer.inputs; ++i) largest = simd::maximum(largest, load<V>(inputs + i * kLanes));
      V sum = {};
      for (int i = 0; i < layer.inputs; ++i) {
        const V weight = simd::exponential(load<V>(inputs + i * kLanes) - largest);
        sum += weight;
        store(weight, outputs + i * kLanes);
      }
      for (int i = 0; i < layer.inputs; ++i) store(load<V>(outputs + i * kLanes) / sum, outputs + i * kLanes);
    }
  }

  static void step(const BatchLayer* layers, int layer_count, const float* weights, int parity, float* memory) {
    for (const BatchLayer* layer = layers; layer != layers + layer_count; ++layer) {
      switch (layer->function) {
        case BatchFunction::kLstm:
          stepLstm<false>(*layer, weights, parity, memory);
          break;
        case BatchFunction::kLstmWithSigmoidCandidate:
          stepLstm<true>(*layer, weights, parity, memory);
          break;
        case BatchFunction::kSoftmax:
          stepSoftmax(*layer, parity, memory);
          break;
        default:
          stepUnits(*layer, weights, parity, memory);
      }
    }
  }

  static constexpr BatchTileKernel kernel() { return {kLanes, step}; }
};

}  // namespace

// What was fastest. Going through functions together pays where there are registers enough for it.
#if defined(__AVX512F__)
const BatchKernels kBatchKernelsAvx512 = {
    4,
    {Tile<simd::Floats<8>, 1, 4, 1>::kernel(), Tile<simd::Floats<16>, 1, 4, 4>::kernel(),
     Tile<simd::Floats<16>, 2, 2, 4>::kernel(), Tile<simd::Floats<16>, 4, 1, 4>::kernel()}};
#elif defined(__AVX2__)
const BatchKernels kBatchKernelsAvx2 = {
    3,
    {Tile<simd::Floats<8>, 1, 2, 1>::kernel(), Tile<simd::Floats<8>, 2, 1, 1>::kernel(),
     Tile<simd::Floats<8>, 3, 1, 1>::kernel()}};
#else
const BatchKernels kBatchKernelsBaseline = {
    2, {Tile<simd::Floats<4>, 1, 2, 1>::kernel(), Tile<simd::Floats<4>, 2, 1, 2>::kernel()}};
#endif

}  // namespace lstm_planner
