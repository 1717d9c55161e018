#pragma once

#include <vector>

namespace lstm_planner {

/// The instruction sets that the kernels of the network are compiled for. All are built from one source; which one runs
/// is chosen at run time, so that one binary works on every machine.
enum class InstructionSet {
  kBaseline,  ///< what the build assumes: SSE2 on x86-64, NEON on 64-bit ARM
  kAvx2,      ///< with FMA
  kAvx512     ///< F, DQ, BW and VL
};

/// "baseline", "AVX2", "AVX-512".
const char* toString(InstructionSet set);

/// The compiled sets that this machine can run, the fastest last; kBaseline is always among them.
const std::vector<InstructionSet>& runnableInstructionSets();

/// The last of runnableInstructionSets().
InstructionSet fastestInstructionSet();

}  // namespace lstm_planner
