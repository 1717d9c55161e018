#include "fuzz/harness.hpp"

/// libFuzzer's; the program holds one harness.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const lstm_planner::fuzz::Harness harness = lstm_planner::fuzz::harnesses().begin()->second;
  harness(data, size);
  return 0;
}
