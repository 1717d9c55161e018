#include "robot/driving/shield_kernels.hpp"

namespace lstm_planner {

const ShieldKernels& shieldKernels(InstructionSet set) {
  static const ShieldKernels baseline = baselineShieldKernels();
#if defined(__x86_64__)
  if (set == InstructionSet::kAvx2) {
    static const ShieldKernels avx2 = avx2ShieldKernels();
    return avx2;
  }
  if (set == InstructionSet::kAvx512) {
    static const ShieldKernels avx512 = avx512ShieldKernels();
    return avx512;
  }
#endif
  static_cast<void>(set);
  return baseline;
}

const ShieldKernels& shieldKernels() {
  static const ShieldKernels& fastest = shieldKernels(fastestInstructionSet());
  return fastest;
}

}  // namespace lstm_planner
