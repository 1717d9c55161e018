#pragma once

namespace lstm_planner {

/// What floor_source.hpp measures with, made once for each instruction set. Results are returned so that they are
/// computed.
struct FloorKernels {
  int lanes;      ///< numbers in a register
  int registers;  ///< vector registers
  float (*multiply_add_chain)(long count, float seed);
  float (*multiplication_chain)(long count, float seed);
  float (*addition_chain)(long count, float seed);
  float (*division_chain)(long count, float seed);
  float (*broadcast_chain)(long count, float seed);
  float (*multiply_adds)(long count, float seed);
  float (*read_buffer)(const float* buffer, long bytes, long passes);
  float (*read_buffer_ahead)(const float* buffer, long bytes, long passes);  ///< with prefetches
};

extern const FloorKernels kFloorBaseline;
#if defined(__x86_64__)
extern const FloorKernels kFloorAvx2;
extern const FloorKernels kFloorAvx512;
#endif

}  // namespace lstm_planner
