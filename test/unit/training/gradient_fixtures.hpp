#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <vector>

#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/training/gradient.hpp"
#include "unit/network/network_fixtures.hpp"

namespace lstm_planner {

/// The loss of sequences, one after the other (thesis Eq. 2.6, 2.31).
inline double doubleLoss(LayerStack layers, const Eigen::VectorXd& parameters,
                         const std::vector<const Sequence*>& batch, Loss loss) {
  if (std::holds_alternative<SoftmaxLayer>(layers.back())) layers.pop_back();  // it is the one of the loss
  double sum = 0.0;
  for (const Sequence* sequence : batch) {
    test::ReferenceNetwork network(layers, parameters);
    for (Eigen::Index step = 0; step < sequence->steps(); ++step) {
      const Eigen::VectorXd preferences = network.forward(sequence->inputs.col(step).cast<double>());
      const auto weight = static_cast<double>(sequence->weights[step]);
      if (!(weight > 0.0)) continue;
      const int label = sequence->labels[step];
      if (loss == Loss::kEuclidean) {
        sum += weight * 0.5 * (preferences - Eigen::VectorXd::Unit(preferences.size(), label)).squaredNorm();
      } else {
        sum += weight * (std::log(preferences.array().exp().sum()) - preferences[label]);
      }
    }
  }
  return sum;
}

/// The gradient of `value` at `place` by central differences.
inline Eigen::VectorXd centralDifferences(Eigen::VectorXd place,
                                          const std::function<double(const Eigen::VectorXd&)>& value) {
  // Truncation grows with step^2 (1e-10), rounding with 1e-16 * value / step (1e-10 for a value of some tens).
  const double kStep = 1e-5;
  Eigen::VectorXd gradient(place.size());
  for (Eigen::Index index = 0; index < place.size(); ++index) {
    const double kept = place[index];
    place[index] = kept + kStep;
    const double above = value(place);
    place[index] = kept - kStep;
    gradient[index] = (above - value(place)) / (2.0 * kStep);
    place[index] = kept;
  }
  return gradient;
}

}  // namespace lstm_planner
