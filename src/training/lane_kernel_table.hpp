#pragma once

#include "training/lane_kernels.hpp"

namespace lstm_planner {

/// The functions of lane_kernels.hpp as compiled for one instruction set.
struct LaneKernels {
  void (*accumulate_product)(const float* weights, int unit_stride, int input_stride, int units, int inputs_count,
                             const float* inputs, float* outputs, int lanes);
  void (*accumulate_weight_gradient)(const float* unit_gradients, const float* inputs, int units, int inputs_count,
                                     int steps, float* gradient, int lanes);
  void (*accumulate_bias_gradient)(const float* unit_gradients, int units, int steps, float* gradient, int lanes);
  void (*apply_tanh)(float* values, int count);
  void (*multiply_by_tanh_derivative)(const float* results, float* gradient, int count);
  void (*lstm_forward)(float* gates, const float* previous_cell, float* cell, float* cell_tanh, float* output,
                       int cells, int lanes, Candidate candidate);
  void (*lstm_backward)(float* gates, const float* previous_cell, const float* cell_tanh, const float* output_gradient,
                        float* cell_gradient, int cells, int lanes, Candidate candidate);
};

extern const LaneKernels kLaneKernelsBaseline;
#if defined(__x86_64__)
extern const LaneKernels kLaneKernelsAvx2;
extern const LaneKernels kLaneKernelsAvx512;
#endif

}  // namespace lstm_planner
