#include "lane_kernels.hpp"

#include <cstdint>
#include <cstring>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#if __GNUC__ >= 12
#define LSTM_PLANNER_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define LSTM_PLANNER_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#endif
#else
#define LSTM_PLANNER_CLONES
#endif
#define LSTM_PLANNER_INLINE __attribute__((always_inline)) inline

// Vectors are never passed between functions that are really called, so their calling convention does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace lstm_planner {
namespace {

typedef float Group __attribute__((vector_size(kLaneGroup * sizeof(float)), aligned(4)));
typedef std::int32_t IntegerGroup __attribute__((vector_size(kLaneGroup * sizeof(std::int32_t)), aligned(4)));

LSTM_PLANNER_INLINE Group load(const float* values) {
  Group group;
  std::memcpy(&group, values, sizeof(group));
  return group;
}
LSTM_PLANNER_INLINE void store(const Group& group, float* values) { std::memcpy(values, &group, sizeof(group)); }

LSTM_PLANNER_INLINE float sumOf(const Group& group) {
  float sum = 0.0f;
  for (int lane = 0; lane < kLaneGroup; ++lane) sum += group[lane];
  return sum;
}

LSTM_PLANNER_INLINE Group smaller(const Group& a, const Group& b) { return a < b ? a : b; }
LSTM_PLANNER_INLINE Group larger(const Group& a, const Group& b) { return a > b ? a : b; }

/// exp(x) for |x| <= 87: 2^n times the series of exp on +-ln(2)/2, whose first term left out is 1.2e-7 of the sum.
LSTM_PLANNER_INLINE Group exponential(const Group& x) {
  constexpr float kLog2e = 1.44269504f;
  constexpr float kLn2High = 0.693359375f;
  constexpr float kLn2Low = -2.12194440e-4f;
  constexpr float kRound = 12582912.0f;  // 1.5 * 2^23: adding it leaves no room for fractions
  const Group rounded = (x * kLog2e + kRound) - kRound;
  const Group rest = (x - rounded * kLn2High) - rounded * kLn2Low;
  Group series = rest * (1.0f / 720.0f) + (1.0f / 120.0f);
  series = series * rest + (1.0f / 24.0f);
  series = series * rest + (1.0f / 6.0f);
  series = series * rest + 0.5f;
  series = series * rest + 1.0f;
  series = series * rest + 1.0f;
  const IntegerGroup exponent = (__builtin_convertvector(rounded, IntegerGroup) + 127) << 23;
  Group power;
  std::memcpy(&power, &exponent, sizeof(power));
  return series * power;
}

LSTM_PLANNER_INLINE Group sigmoid(const Group& x) {
  const Group limit = Group{} + 30.0f;
  return 1.0f / (1.0f + exponential(-smaller(larger(x, -limit), limit)));
}

LSTM_PLANNER_INLINE Group hyperbolicTangent(const Group& x) { return 2.0f * sigmoid(2.0f * x) - 1.0f; }

constexpr int kUnitBlock = 4;
constexpr int kInputBlock = 4;

template <int kUnits>
LSTM_PLANNER_INLINE void productOfUnits(const float* weights, int unit_stride, int input_stride, int inputs_count,
                                        const float* inputs, float* outputs, int lanes) {
  for (int lane = 0; lane < lanes; lane += kLaneGroup) {
    Group sums[kUnits];
    for (int unit = 0; unit < kUnits; ++unit) sums[unit] = load(outputs + unit * lanes + lane);
    for (int k = 0; k < inputs_count; ++k) {
      const Group input = load(inputs + k * lanes + lane);
      const float* weight = weights + k * input_stride;
      for (int unit = 0; unit < kUnits; ++unit) sums[unit] += weight[unit * unit_stride] * input;
    }
    for (int unit = 0; unit < kUnits; ++unit) store(sums[unit], outputs + unit * lanes + lane);
  }
}

template <int kUnits, int kInputs>
LSTM_PLANNER_INLINE void weightGradientBlock(const float* unit_gradients, const float* inputs, int units,
                                             int inputs_count, int steps, float* gradient, int lanes) {
  Group sums[kUnits][kInputs] = {};
  for (int step = 0; step < steps; ++step) {
    for (int lane = 0; lane < lanes; lane += kLaneGroup) {
      Group input[kInputs];
      for (int k = 0; k < kInputs; ++k) input[k] = load(inputs + k * lanes + lane);
      for (int unit = 0; unit < kUnits; ++unit) {
        const Group unit_gradient = load(unit_gradients + unit * lanes + lane);
        for (int k = 0; k < kInputs; ++k) sums[unit][k] += unit_gradient * input[k];
      }
    }
    unit_gradients += units * lanes;
    inputs += inputs_count * lanes;
  }
  for (int k = 0; k < kInputs; ++k) {
    for (int unit = 0; unit < kUnits; ++unit) gradient[k * units + unit] += sumOf(sums[unit][k]);
  }
}

}  // namespace

LSTM_PLANNER_CLONES
void accumulateProduct(const float* weights, int unit_stride, int input_stride, int units, int inputs_count,
                       const float* inputs, float* outputs, int lanes) {
  int unit = 0;
  for (; unit + 2 * kUnitBlock <= units; unit += 2 * kUnitBlock) {
    productOfUnits<2 * kUnitBlock>(weights + unit * unit_stride, unit_stride, input_stride, inputs_count, inputs,
                                   outputs + unit * lanes, lanes);
  }
  for (; unit + kUnitBlock <= units; unit += kUnitBlock) {
    productOfUnits<kUnitBlock>(weights + unit * unit_stride, unit_stride, input_stride, inputs_count, inputs,
                               outputs + unit * lanes, lanes);
  }
  for (; unit < units; ++unit) {
    productOfUnits<1>(weights + unit * unit_stride, unit_stride, input_stride, inputs_count, inputs,
                      outputs + unit * lanes, lanes);
  }
}

LSTM_PLANNER_CLONES
void accumulateWeightGradient(const float* unit_gradients, const float* inputs, int units, int inputs_count, int steps,
                              float* gradient, int lanes) {
  for (int k = 0; k < inputs_count;) {
    const bool whole_inputs = k + kInputBlock <= inputs_count;
    for (int unit = 0; unit < units;) {
      const float* gradients = unit_gradients + unit * lanes;
      const float* rows = inputs + k * lanes;
      float* sums = gradient + k * units + unit;
      const bool whole_units = unit + kUnitBlock <= units;
      if (whole_units && whole_inputs) {
        weightGradientBlock<kUnitBlock, kInputBlock>(gradients, rows, units, inputs_count, steps, sums, lanes);
      } else if (whole_units) {
        weightGradientBlock<kUnitBlock, 1>(gradients, rows, units, inputs_count, steps, sums, lanes);
      } else if (whole_inputs) {
        weightGradientBlock<1, kInputBlock>(gradients, rows, units, inputs_count, steps, sums, lanes);
      } else {
        weightGradientBlock<1, 1>(gradients, rows, units, inputs_count, steps, sums, lanes);
      }
      unit += whole_units ? kUnitBlock : 1;
    }
    k += whole_inputs ? kInputBlock : 1;
  }
}

LSTM_PLANNER_CLONES
void accumulateBiasGradient(const float* unit_gradients, int units, int steps, float* gradient, int lanes) {
  for (int unit = 0; unit < units; ++unit) {
    Group sum = {};
    for (int step = 0; step < steps; ++step) {
      const float* row = unit_gradients + (step * units + unit) * lanes;
      for (int lane = 0; lane < lanes; lane += kLaneGroup) sum += load(row + lane);
    }
    gradient[unit] += sumOf(sum);
  }
}

LSTM_PLANNER_CLONES
void setRows(const float* values, int rows, float* outputs, int lanes) {
  for (int row = 0; row < rows; ++row) {
    for (int lane = 0; lane < lanes; ++lane) outputs[row * lanes + lane] = values[row];
  }
}

LSTM_PLANNER_CLONES
void applyTanh(float* values, int count) {
  for (int i = 0; i < count; i += kLaneGroup) store(hyperbolicTangent(load(values + i)), values + i);
}

LSTM_PLANNER_CLONES
void multiplyByTanhDerivative(const float* results, float* gradient, int count) {
  for (int i = 0; i < count; ++i) gradient[i] *= 1.0f - results[i] * results[i];
}

LSTM_PLANNER_CLONES
void lstmForward(float* gates, const float* previous_cell, float* cell, float* cell_tanh, float* output, int cells,
                 int lanes) {
  const int count = cells * lanes;
  for (int i = 0; i < count; i += kLaneGroup) {
    const Group input_gate = sigmoid(load(gates + i));
    const Group output_gate = sigmoid(load(gates + count + i));
    const Group forget_gate = sigmoid(load(gates + 2 * count + i));
    const Group candidate = hyperbolicTangent(load(gates + 3 * count + i));
    const Group next = forget_gate * load(previous_cell + i) + input_gate * candidate;
    const Group next_tanh = hyperbolicTangent(next);
    store(input_gate, gates + i);
    store(output_gate, gates + count + i);
    store(forget_gate, gates + 2 * count + i);
    store(candidate, gates + 3 * count + i);
    store(next, cell + i);
    store(next_tanh, cell_tanh + i);
    store(next_tanh * output_gate, output + i);
  }
}

LSTM_PLANNER_CLONES
void lstmBackward(float* gates, const float* previous_cell, const float* cell_tanh, const float* output_gradient,
                  float* cell_gradient, int cells, int lanes) {
  const int count = cells * lanes;
  for (int i = 0; i < count; i += kLaneGroup) {
    const Group input_gate = load(gates + i);
    const Group output_gate = load(gates + count + i);
    const Group forget_gate = load(gates + 2 * count + i);
    const Group candidate = load(gates + 3 * count + i);
    const Group by_output = load(output_gradient + i);
    const Group tanh_of_cell = load(cell_tanh + i);
    const Group by_cell = load(cell_gradient + i) + by_output * output_gate * (1.0f - tanh_of_cell * tanh_of_cell);
    store(by_cell * candidate * input_gate * (1.0f - input_gate), gates + i);
    store(by_output * tanh_of_cell * output_gate * (1.0f - output_gate), gates + count + i);
    store(by_cell * load(previous_cell + i) * forget_gate * (1.0f - forget_gate), gates + 2 * count + i);
    store(by_cell * input_gate * (1.0f - candidate * candidate), gates + 3 * count + i);
    store(by_cell * forget_gate, cell_gradient + i);
  }
}

}  // namespace lstm_planner
