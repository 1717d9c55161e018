#include "robot/perception/scan_kernels.hpp"

namespace lstm_planner {

const ScanKernels& scanKernels(InstructionSet set) {
  static const ScanKernels baseline = baselineScanKernels();
#if defined(__x86_64__)
  if (set == InstructionSet::kAvx2) {
    static const ScanKernels avx2 = avx2ScanKernels();
    return avx2;
  }
  if (set == InstructionSet::kAvx512) {
    static const ScanKernels avx512 = avx512ScanKernels();
    return avx512;
  }
#endif
  static_cast<void>(set);
  return baseline;
}

const ScanKernels& scanKernels() {
  static const ScanKernels& fastest = scanKernels(fastestInstructionSet());
  return fastest;
}

}  // namespace lstm_planner
