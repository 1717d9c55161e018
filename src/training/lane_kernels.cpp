#include "training/lane_kernels.hpp"

#include <algorithm>

#include "lstm_planner/network/instruction_set.hpp"
#include "training/lane_kernel_table.hpp"

namespace lstm_planner {
namespace {

const LaneKernels& fastestKernels() {
#if defined(__x86_64__)
  switch (fastestInstructionSet()) {
    case InstructionSet::kAvx512:
      return kLaneKernelsAvx512;
    case InstructionSet::kAvx2:
      return kLaneKernelsAvx2;
    case InstructionSet::kBaseline:
      break;
  }
#endif
  return kLaneKernelsBaseline;
}

const LaneKernels& kernels() {
  static const LaneKernels& fastest = fastestKernels();
  return fastest;
}

}  // namespace

void accumulateProduct(const float* weights, int unit_stride, int input_stride, int units, int inputs_count,
                       const float* inputs, float* outputs, int lanes) {
  kernels().accumulate_product(weights, unit_stride, input_stride, units, inputs_count, inputs, outputs, lanes);
}

void accumulateWeightGradient(const float* unit_gradients, const float* inputs, int units, int inputs_count, int steps,
                              float* gradient, int lanes) {
  kernels().accumulate_weight_gradient(unit_gradients, inputs, units, inputs_count, steps, gradient, lanes);
}

void accumulateBiasGradient(const float* unit_gradients, int units, int steps, float* gradient, int lanes) {
  kernels().accumulate_bias_gradient(unit_gradients, units, steps, gradient, lanes);
}

void setRows(const float* values, int rows, float* outputs, int lanes) {
  for (int row = 0; row < rows; ++row) std::fill_n(outputs + row * lanes, lanes, values[row]);
}

void applyTanh(float* values, int count) { kernels().apply_tanh(values, count); }

void multiplyByTanhDerivative(const float* results, float* gradient, int count) {
  kernels().multiply_by_tanh_derivative(results, gradient, count);
}

void lstmForward(float* gates, const float* previous_cell, float* cell, float* cell_tanh, float* output, int cells,
                 int lanes, Candidate candidate) {
  kernels().lstm_forward(gates, previous_cell, cell, cell_tanh, output, cells, lanes, candidate);
}

void lstmBackward(float* gates, const float* previous_cell, const float* cell_tanh, const float* output_gradient,
                  float* cell_gradient, int cells, int lanes, Candidate candidate) {
  kernels().lstm_backward(gates, previous_cell, cell_tanh, output_gradient, cell_gradient, cells, lanes, candidate);
}

}  // namespace lstm_planner
