#pragma once

#include "lstm_planner/network/activation.hpp"

namespace lstm_planner {

/// `lanes` is a multiple of this.
constexpr int kLaneGroup = 16;

/// Arithmetic on many steps side by side: a value of the network is a row of `lanes` numbers, one for each agent or
/// sequence that is at the same step, so that one instruction works for 16 of them whatever the sizes of the layers
/// are. Rows lie one behind the other.
///
/// These functions are compiled several times, for the instruction sets of x86-64. The results of those that multiply
/// and add in one instruction are the same; the baseline's differ in rounding.
struct LaneKernels {
  /// outputs[unit] += sum over k of weights[unit * unit_stride + k * input_stride] * inputs[k]: a layer's product, and
  /// with exchanged strides that of its transposed weights.
  void (*accumulateProduct)(const float* weights, int unit_stride, int input_stride, int units, int inputs_count,
                            const float* inputs, float* outputs, int lanes);

  /// gradient[k * units + unit] += sum over steps and lanes of unit_gradients[unit] * inputs[k]; the rows of a step lie
  /// behind those of the step before.
  void (*accumulateWeightGradient)(const float* unit_gradients, const float* inputs, int units, int inputs_count,
                                   int steps, float* gradient, int lanes);

  /// gradient[unit] += sum over steps and lanes of unit_gradients[unit].
  void (*accumulateBiasGradient)(const float* unit_gradients, int units, int steps, float* gradient, int lanes);

  void (*applyTanh)(float* values, int count);
  /// gradient *= 1 - result^2.
  void (*multiplyByTanhDerivative)(const float* results, float* gradient, int count);

  /// One step of LSTM cells. `gates` holds the weighted sums of i, o, f, c (cells rows each) and gets their
  /// activations; `cell` is the new cell state, `cell_tanh` its tanh, `output` the layer's output; `candidate` is kTanh
  /// or kSigmoid.
  void (*lstmForward)(float* gates, const float* previous_cell, float* cell, float* cell_tanh, float* output, int cells,
                      int lanes, Activation candidate);

  /// Back through one step: `output_gradient` by the output; `cell_gradient` by the new cell state from the step after,
  /// becomes that by the previous cell state; `gates` become gradients by the weighted sums.
  void (*lstmBackward)(float* gates, const float* previous_cell, const float* cell_tanh, const float* output_gradient,
                       float* cell_gradient, int cells, int lanes, Activation candidate);
};

extern const LaneKernels kLaneKernelsBaseline;
#if defined(__x86_64__)
extern const LaneKernels kLaneKernelsAvx2;
extern const LaneKernels kLaneKernelsAvx512;
#endif

/// The fastest that the machine has.
const LaneKernels& laneKernels();

}  // namespace lstm_planner
