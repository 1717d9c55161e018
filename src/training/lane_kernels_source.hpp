// Included once by each lane_kernels_*.cpp, which are compiled for different instruction sets. Only the table at the
// end, LANE_KERNELS, may have external linkage (see simd.hpp). What is computed side by side does not change any
// result: every sum is made in the same order, and the sets with a multiply-add in one instruction give the same bits.

#include <cstddef>

#include "training/lane_functions.hpp"

namespace lstm_planner {
namespace {

// How many sums a product or a gradient has under way: enough to hide how long a multiply-add takes, and few enough to
// stay in the registers.
#if defined(__AVX512F__)
constexpr int kUnitBlock = 8;
constexpr int kVectorBlock = 2;
constexpr int kGradientUnits = 4;
constexpr int kGradientInputs = 4;
constexpr int kTogether = 4;  ///< vectors that go through a cell's functions
#elif defined(__AVX2__)
constexpr int kUnitBlock = 4;
constexpr int kVectorBlock = 2;
constexpr int kGradientUnits = 2;
constexpr int kGradientInputs = 2;
constexpr int kTogether = 2;
#else
constexpr int kUnitBlock = 4;
constexpr int kVectorBlock = 2;
constexpr int kGradientUnits = 2;
constexpr int kGradientInputs = 1;
constexpr int kTogether = 2;
#endif

/// The outputs of kUnits units for kCount vectors of lanes.
template <int kUnits, int kCount>
LSTM_PLANNER_INLINE void productBlock(const float* weights, int unit_stride, int input_stride, int inputs_count,
                                      const float* inputs, float* outputs, int lanes) {
  using V = Vectors<kCount>;
  V sums[kUnits];
  for (int unit = 0; unit < kUnits; ++unit) sums[unit] = loadGroup<V>(outputs + unit * lanes);
  for (int k = 0; k < inputs_count; ++k) {
    const V input = loadGroup<V>(inputs + k * lanes);
    const float* weight = weights + k * input_stride;
    for (int unit = 0; unit < kUnits; ++unit) {
      for (int i = 0; i < kCount; ++i) sums[unit].of[i] += weight[unit * unit_stride] * input.of[i];
    }
  }
  for (int unit = 0; unit < kUnits; ++unit) store(sums[unit], outputs + unit * lanes);
}

template <int kUnits>
LSTM_PLANNER_INLINE void productOfUnits(const float* weights, int unit_stride, int input_stride, int inputs_count,
                                        const float* inputs, float* outputs, int lanes) {
  constexpr int kBlockLanes = kVectorBlock * kWidest;
  int lane = 0;
  for (; lane + kBlockLanes <= lanes; lane += kBlockLanes) {
    productBlock<kUnits, kVectorBlock>(weights, unit_stride, input_stride, inputs_count, inputs + lane, outputs + lane,
                                       lanes);
  }
  for (; lane < lanes; lane += kWidest) {
    productBlock<kUnits, 1>(weights, unit_stride, input_stride, inputs_count, inputs + lane, outputs + lane, lanes);
  }
}

void accumulateProductOfLanes(const float* weights, int unit_stride, int input_stride, int units, int inputs_count,
                              const float* inputs, float* outputs, int lanes) {
  int unit = 0;
  for (; unit + kUnitBlock <= units; unit += kUnitBlock) {
    productOfUnits<kUnitBlock>(weights + unit * unit_stride, unit_stride, input_stride, inputs_count, inputs,
                               outputs + unit * lanes, lanes);
  }
  for (; unit < units; ++unit) {
    productOfUnits<1>(weights + unit * unit_stride, unit_stride, input_stride, inputs_count, inputs,
                      outputs + unit * lanes, lanes);
  }
}

template <int kUnits, int kInputs>
LSTM_PLANNER_INLINE void weightGradientBlock(const float* unit_gradients, const float* inputs, int units,
                                             int inputs_count, int steps, float* gradient, int lanes) {
  constexpr int kCount = kLaneGroup / kWidest;
  LaneGroup sums[kUnits][kInputs] = {};
  for (int step = 0; step < steps; ++step) {
    for (int lane = 0; lane < lanes; lane += kLaneGroup) {
      LaneGroup input[kInputs];
      for (int k = 0; k < kInputs; ++k) input[k] = loadGroup<LaneGroup>(inputs + k * lanes + lane);
      for (int unit = 0; unit < kUnits; ++unit) {
        const LaneGroup unit_gradient = loadGroup<LaneGroup>(unit_gradients + unit * lanes + lane);
        for (int k = 0; k < kInputs; ++k) {
          for (int i = 0; i < kCount; ++i) sums[unit][k].of[i] += unit_gradient.of[i] * input[k].of[i];
        }
      }
    }
    unit_gradients += units * lanes;
    inputs += inputs_count * lanes;
  }
  for (int k = 0; k < kInputs; ++k) {
    for (int unit = 0; unit < kUnits; ++unit) gradient[k * units + unit] += sumOf(sums[unit][k]);
  }
}

/// The gradients of a block of units stay in the cache while the inputs pass by.
template <int kUnits>
LSTM_PLANNER_INLINE void weightGradientOfUnits(const float* unit_gradients, const float* inputs, int units,
                                               int inputs_count, int steps, float* gradient, int lanes) {
  int k = 0;
  for (; k + kGradientInputs <= inputs_count; k += kGradientInputs) {
    weightGradientBlock<kUnits, kGradientInputs>(unit_gradients, inputs + k * lanes, units, inputs_count, steps,
                                                 gradient + k * units, lanes);
  }
  for (; k < inputs_count; ++k) {
    weightGradientBlock<kUnits, 1>(unit_gradients, inputs + k * lanes, units, inputs_count, steps, gradient + k * units,
                                   lanes);
  }
}

void accumulateWeightGradientOfLanes(const float* unit_gradients, const float* inputs, int units, int inputs_count,
                                     int steps, float* gradient, int lanes) {
  int unit = 0;
  for (; unit + kGradientUnits <= units; unit += kGradientUnits) {
    weightGradientOfUnits<kGradientUnits>(unit_gradients + unit * lanes, inputs, units, inputs_count, steps,
                                          gradient + unit, lanes);
  }
  for (; unit < units; ++unit) {
    weightGradientOfUnits<1>(unit_gradients + unit * lanes, inputs, units, inputs_count, steps, gradient + unit, lanes);
  }
}

void accumulateBiasGradientOfLanes(const float* unit_gradients, int units, int steps, float* gradient, int lanes) {
  for (int unit = 0; unit < units; ++unit) {
    LaneGroup sum = {};
    for (int step = 0; step < steps; ++step) {
      const float* row = unit_gradients + static_cast<std::ptrdiff_t>(step * units + unit) * lanes;
      for (int lane = 0; lane < lanes; lane += kLaneGroup) sum = sum + loadGroup<LaneGroup>(row + lane);
    }
    gradient[unit] += sumOf(sum);
  }
}

void applyTanhToLanes(float* values, int count) {
  for (int i = 0; i < count; i += kLaneGroup) store(hyperbolicTangent(loadGroup<LaneGroup>(values + i)), values + i);
}

void multiplyByTanhDerivativeOfLanes(const float* results, float* gradient, int count) {
  for (int i = 0; i < count; i += kLaneGroup) {
    const LaneGroup result = loadGroup<LaneGroup>(results + i);
    store(loadGroup<LaneGroup>(gradient + i) * (1.0f - result * result), gradient + i);
  }
}

template <class V, Activation kCandidate>
LSTM_PLANNER_INLINE void stepCells(float* gates, int gate_stride, const float* previous_cell, float* cell,
                                   float* cell_tanh, float* output) {
  const V input_gate = sigmoid(loadGroup<V>(gates));
  store(input_gate, gates);
  const V candidate_sum = loadGroup<V>(gates + 3 * gate_stride);
  const V candidate = kCandidate == Activation::kTanh ? hyperbolicTangent(candidate_sum) : sigmoid(candidate_sum);
  store(candidate, gates + 3 * gate_stride);
  const V forget_gate = sigmoid(loadGroup<V>(gates + 2 * gate_stride));
  store(forget_gate, gates + 2 * gate_stride);
  V next = forget_gate * loadGroup<V>(previous_cell);
  next = next + input_gate * candidate;
  store(next, cell);
  const V output_gate = sigmoid(loadGroup<V>(gates + gate_stride));
  store(output_gate, gates + gate_stride);
  const V next_tanh = hyperbolicTangent(next);
  store(next_tanh, cell_tanh);
  store(next_tanh * output_gate, output);
}

template <Activation kCandidate>
void stepAllCells(float* gates, const float* previous_cell, float* cell, float* cell_tanh, float* output, int count) {
  constexpr int kStride = kTogether * kWidest;
  int i = 0;
  for (; i + kStride <= count; i += kStride) {
    stepCells<Vectors<kTogether>, kCandidate>(gates + i, count, previous_cell + i, cell + i, cell_tanh + i, output + i);
  }
  for (; i < count; i += kWidest) {
    stepCells<Vectors<1>, kCandidate>(gates + i, count, previous_cell + i, cell + i, cell_tanh + i, output + i);
  }
}

void lstmForwardOfLanes(float* gates, const float* previous_cell, float* cell, float* cell_tanh, float* output,
                        int cells, int lanes, Activation candidate) {
  const auto step =
      candidate == Activation::kTanh ? stepAllCells<Activation::kTanh> : stepAllCells<Activation::kSigmoid>;
  step(gates, previous_cell, cell, cell_tanh, output, cells * lanes);
}

void lstmBackwardOfLanes(float* gates, const float* previous_cell, const float* cell_tanh, const float* output_gradient,
                         float* cell_gradient, int cells, int lanes, Activation activation) {
  using V = Vectors<1>;
  const int count = cells * lanes;
  for (int i = 0; i < count; i += kWidest) {
    const V input_gate = loadGroup<V>(gates + i);
    const V output_gate = loadGroup<V>(gates + count + i);
    const V forget_gate = loadGroup<V>(gates + 2 * count + i);
    const V candidate = loadGroup<V>(gates + 3 * count + i);
    const V by_output = loadGroup<V>(output_gradient + i);
    const V tanh_of_cell = loadGroup<V>(cell_tanh + i);
    const V by_cell = loadGroup<V>(cell_gradient + i) + by_output * output_gate * (1.0f - tanh_of_cell * tanh_of_cell);
    store(by_cell * candidate * input_gate * (1.0f - input_gate), gates + i);
    store(by_output * tanh_of_cell * output_gate * (1.0f - output_gate), gates + count + i);
    store(by_cell * loadGroup<V>(previous_cell + i) * forget_gate * (1.0f - forget_gate), gates + 2 * count + i);
    const V slope = activation == Activation::kTanh ? 1.0f - candidate * candidate : candidate * (1.0f - candidate);
    store(by_cell * input_gate * slope, gates + 3 * count + i);
    store(by_cell * forget_gate, cell_gradient + i);
  }
}

}  // namespace

const LaneKernels LANE_KERNELS = {
    accumulateProductOfLanes, accumulateWeightGradientOfLanes, accumulateBiasGradientOfLanes,
    applyTanhToLanes,         multiplyByTanhDerivativeOfLanes, lstmForwardOfLanes,
    lstmBackwardOfLanes};

}  // namespace lstm_planner
