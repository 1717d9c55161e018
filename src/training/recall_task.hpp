#pragma once

#include <cstdint>
#include <vector>

#include "lstm_planner/training/sequence.hpp"

namespace lstm_planner {

/// The task that shows how long a network remembers (thesis 2.2): one of two symbols at the first step, then random
/// ones for `delay` steps; only the last step counts, and its label is the first symbol. The three inputs are the two
/// symbols and a mark at the first step. `delay` is not negative; the same seed gives the same sequences.
std::vector<Sequence> recallSequences(int count, int delay, std::uint64_t seed);

}  // namespace lstm_planner
