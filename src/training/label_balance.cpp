#include "lstm_planner/training/label_balance.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lstm_planner {

std::vector<long> countLabels(const std::vector<Sequence>& sequences, int classes) {
  std::vector<long> counts(static_cast<std::size_t>(classes), 0);
  for (const Sequence& sequence : sequences) {
    for (Eigen::Index step = 0; step < sequence.steps(); ++step) {
      if (sequence.weights[step] > 0.0f) ++counts.at(static_cast<std::size_t>(sequence.labels[step]));
    }
  }
  return counts;
}

std::vector<double> labelWeights(const std::vector<long>& counts, LabelBalance balance) {
  const double power = balance == LabelBalance::kNone ? 0.0 : balance == LabelBalance::kSquareRoot ? 0.5 : 1.0;
  std::vector<double> weights;
  double weighted = 0.0;
  for (const long count : counts) {
    weights.push_back(count > 0 ? std::pow(static_cast<double>(count), -power) : 0.0);
    weighted += static_cast<double>(count) * weights.back();
  }
  const double steps = static_cast<double>(std::accumulate(counts.begin(), counts.end(), 0L));
  for (double& weight : weights) weight *= weighted > 0.0 ? steps / weighted : 0.0;
  return weights;
}

void weigh(const std::vector<double>& label_weights, std::vector<Sequence>* sequences) {
  for (Sequence& sequence : *sequences) {
    for (Eigen::Index step = 0; step < sequence.steps(); ++step) {
      if (sequence.weights[step] <= 0.0f) continue;
      sequence.weights[step] *= static_cast<float>(label_weights.at(static_cast<std::size_t>(sequence.labels[step])));
    }
  }
}

double constantAnswerAccuracy(const std::vector<long>& counts) {
  const long steps = std::accumulate(counts.begin(), counts.end(), 0L);
  if (steps == 0) return 0.0;
  return static_cast<double>(*std::max_element(counts.begin(), counts.end())) / static_cast<double>(steps);
}

}  // namespace lstm_planner
