#pragma once

#include <vector>

namespace lstm_planner {

/// What a kernel of the network may be compiled for. All are made from one source when the package is built; which one
/// runs is chosen when the program runs, so that one binary fits every machine.
enum class InstructionSet {
  kBaseline,  ///< what the build assumes: SSE2 on x86-64, NEON on 64-bit ARM
  kAvx2,      ///< with FMA
  kAvx512     ///< F, DQ, BW and VL
};

/// "baseline", "AVX2", "AVX-512".
const char* toString(InstructionSet set);

/// The sets that were compiled in and that this machine can run, the fastest last; kBaseline always.
const std::vector<InstructionSet>& runnableInstructionSets();

/// The last of runnableInstructionSets().
InstructionSet fastestInstructionSet();

}  // namespace lstm_planner
