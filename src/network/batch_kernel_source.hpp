// Included once by each batch_kernel_*.cpp, which are compiled for different instruction sets. Only the table at the end
// may have external linkage (see simd.hpp).

#include "batch_kernel.hpp"
#include "simd.hpp"

namespace lstm_planner {
namespace {

using simd::Fraction;
using simd::broadcast;
using simd::load;
using simd::multiplyAdd;
using simd::store;

/// kVectors vectors side by side are a row; kBlocks blocks are summed at a time, so that enough sums are under way to
/// hide how long a multiply-add takes, and few enough to stay in the registers.
template <class V, int kVectors, int kBlocks>
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
  template <bool kSigmoidCandidate>
  LSTM_PLANNER_INLINE static void stepCell(const V& input_sum, const V& output_sum, const V& forget_sum,
                                           const V& candidate_sum, float* cell, float* output) {
    const Fraction<V> input_gate = simd::twiceSigmoidOfTwiceFraction(input_sum);
    const Fraction<V> candidate = kSigmoidCandidate ? simd::twiceSigmoidOfTwiceFraction(candidate_sum)
                                                    : simd::tanhFraction(candidate_sum);
    const V forget_gate = simd::value(simd::twiceSigmoidOfTwiceFraction(forget_sum));
    const V half = broadcast<V>(0.5f);
    const V news_scale = broadcast<V>(kSigmoidCandidate ? 0.25f : 0.5f);
    const V news = input_gate.numerator * candidate.numerator * news_scale /
                   (input_gate.denominator * candidate.denominator);
    const V state = simd::flushTiny(multiplyAdd(forget_gate * half, load<V>(cell), news));
    store(cell, state);
    const Fraction<V> output_gate = simd::twiceSigmoidOfTwiceFraction(output_sum);
    const Fraction<V> squashed = simd::tanhFraction(state);
    store(output, squashed.numerator * output_gate.numerator * half /
                      (squashed.denominator * output_gate.denominator));
  }

  template <bool kSigmoidCandidate, int kCount>
  LSTM_PLANNER_INLINE static void stepCells(const BatchLayer& layer, const float* weights, int parity, int block,
                                            float* memory) {
    Sums<kCount> sums;
    weigh<kCount>(layer, weights, parity, block, memory, &sums);
    for (int cell = 0; cell < kCount; ++cell) {
      float* const states = row(memory, layer.cell_row + block + cell);
      float* const outputs = row(memory, layer.output_row[parity] + block + cell);
      for (int v = 0; v < kVectors; ++v) {
        stepCell<kSigmoidCandidate>(sums.of[cell][0][v], sums.of[cell][1][v], sums.of[cell][2][v], sums.of[cell][3][v],
                                    states + v * kVectorLanes, outputs + v * kVectorLanes);
      }
    }
  }

  template <bool kSigmoidCandidate>
  LSTM_PLANNER_INLINE static void stepLstm(const BatchLayer& layer, const float* weights, int parity, float* memory) {
    int cell = 0;
    for (; cell + kBlocks <= layer.outputs; cell += kBlocks) {
      stepCells<kSigmoidCandidate, kBlocks>(layer, weights, parity, cell, memory);
    }
    for (; cell < layer.outputs; ++cell) stepCells<kSigmoidCandidate, 1>(layer, weights, parity, cell, memory);
  }

  LSTM_PLANNER_INLINE static V activation(BatchFunction function, const V& sum) {
    switch (function) {
      case BatchFunction::kTanh:
        return simd::tanh(sum);
      case BatchFunction::kSigmoid:
        return simd::value(simd::twiceSigmoidOfTwiceFraction(sum)) * broadcast<V>(0.5f);
      case BatchFunction::kRelu:
        return simd::maximum(sum, V{});
      default:
        return sum;
    }
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
        store(outputs + v * kVectorLanes, activation(layer.function, sums.of[i / kBatchBlock][i % kBatchBlock][v]));
      }
    }
  }

  LSTM_PLANNER_INLINE static void stepUnits(const BatchLayer& layer, const float* weights, int parity, float* memory) {
    const int blocks = (layer.outputs + kBatchBlock - 1) / kBatchBlock;
    int block = 0;
    for (; block + kBlocks <= blocks; block += kBlocks) {
      stepUnitBlocks<kBlocks>(layer, weights, parity, block, memory);
    }
    for (; block < blocks; ++block) stepUnitBlocks<1>(layer, weights, parity, block, memory);
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
        store(outputs + i * kLanes, weight);
      }
      for (int i = 0; i < layer.inputs; ++i) store(outputs + i * kLanes, load<V>(outputs + i * kLanes) / sum);
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

#if defined(__AVX512F__)
const BatchKernels kBatchKernelsAvx512 = {
    4,
    {Tile<simd::Floats<8>, 1, 4>::kernel(), Tile<simd::Floats<16>, 1, 4>::kernel(),
     Tile<simd::Floats<16>, 2, 2>::kernel(), Tile<simd::Floats<16>, 4, 1>::kernel()}};
#elif defined(__AVX2__)
const BatchKernels kBatchKernelsAvx2 = {
    2, {Tile<simd::Floats<8>, 1, 2>::kernel(), Tile<simd::Floats<8>, 2, 1>::kernel()}};
#else
const BatchKernels kBatchKernelsBaseline = {
    2, {Tile<simd::Floats<4>, 1, 2>::kernel(), Tile<simd::Floats<4>, 2, 1>::kernel()}};
#endif

}  // namespace lstm_planner
