#include "lstm_planner/network/instruction_set.hpp"

namespace lstm_planner {

namespace {

std::vector<InstructionSet> findRunnable() {
  std::vector<InstructionSet> sets = {InstructionSet::kBaseline};
#if defined(__x86_64__)
  // The answers include whether the operating system saves the registers.
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    sets.push_back(InstructionSet::kAvx2);
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512vl")) {
      sets.push_back(InstructionSet::kAvx512);
    }
  }
#endif
  return sets;
}

}  // namespace

const char* toString(InstructionSet set) {
  switch (set) {
    case InstructionSet::kBaseline:
      return "baseline";
    case InstructionSet::kAvx2:
      return "AVX2";
    case InstructionSet::kAvx512:
      return "AVX-512";
  }
  return "unknown";
}

const std::vector<InstructionSet>& runnableInstructionSets() {
  static const std::vector<InstructionSet> sets = findRunnable();
  return sets;
}

InstructionSet fastestInstructionSet() { return runnableInstructionSets().back(); }

}  // namespace lstm_planner
