#include "training/lane_kernels.hpp"

#include "lstm_planner/network/instruction_set.hpp"

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

}  // namespace

const LaneKernels& laneKernels() {
  static const LaneKernels& fastest = fastestKernels();
  return fastest;
}

}  // namespace lstm_planner
