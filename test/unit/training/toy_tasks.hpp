#pragma once

#include <vector>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/training/memory_comparison.hpp"
#include "lstm_planner/training/sequence.hpp"

namespace lstm_planner {

/// Random bits; the label of each step is the parity of all bits so far.
inline std::vector<Sequence> paritySequences(int count, int steps, std::uint64_t seed) {
  Random random(seed);
  std::vector<Sequence> sequences;
  for (int index = 0; index < count; ++index) {
    Sequence sequence{Eigen::MatrixXf::Zero(1, steps), Eigen::VectorXi::Zero(steps), Eigen::VectorXf::Ones(steps)};
    int parity = 0;
    for (int step = 0; step < steps; ++step) {
      const int bit = static_cast<int>(uniformIndex(random, 2));
      parity ^= bit;
      sequence.inputs(0, step) = static_cast<float>(bit);
      sequence.labels[step] = parity;
    }
    sequences.push_back(sequence);
  }
  return sequences;
}

}  // namespace lstm_planner
