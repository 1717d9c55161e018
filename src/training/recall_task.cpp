#include "training/recall_task.hpp"

#include "lstm_planner/common/random.hpp"

namespace lstm_planner {

std::vector<Sequence> recallSequences(int count, int delay, std::uint64_t seed) {
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

}  // namespace lstm_planner
