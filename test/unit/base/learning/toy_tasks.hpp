#pragma once

#include <vector>

#include "lstm_planner/base/common/random.hpp"
#include "lstm_planner/base/learning/sequence.hpp"

namespace lstm_planner {

/// Shows one of two symbols at the first step, then random ones for `delay` steps; only the last step counts, and its
/// label is the first symbol. The three inputs are the two symbols and a mark at the first step.
inline std::vector<Sequence> recallSequences(int count, int delay, std::uint64_t seed) {
  Random random(seed);
  std::vector<Sequence> sequences;
  for (int index = 0; index < count; ++index) {
    Sequence sequence{Eigen::MatrixXf::Zero(3, delay + 1), Eigen::VectorXi::Zero(delay + 1),
                      Eigen::VectorXf::Zero(delay + 1)};
    for (int step = 0; step <= delay; ++step) {
      sequence.inputs(static_cast<Eigen::Index>(uniformIndex(random, 2)), step) = 1.0f;
    }
    sequence.inputs(2, 0) = 1.0f;
    sequence.labels[delay] = sequence.inputs(0, 0) > 0.5f ? 0 : 1;
    sequence.weights[delay] = 1.0f;
    sequences.push_back(sequence);
  }
  return sequences;
}

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
