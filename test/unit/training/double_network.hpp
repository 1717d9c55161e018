#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <vector>

#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/training/gradient.hpp"

namespace lstm_planner {

/// A stack in double precision, step by step, as its equations say (thesis Eq. 2.1-2.4, 2.14, 2.21-2.25): what the
/// lanes are held to.
class DoubleNetwork {
 public:
  /// `parameters` as of parameterVector().
  DoubleNetwork(const LayerStack& layers, const Eigen::VectorXd& parameters)
      : layers_(layers), parameters_(parameters), states_(layers.size()) {}

  /// The preferences: a softmax at the end is left out.
  Eigen::VectorXd forward(const Eigen::VectorXd& inputs) {
    Eigen::VectorXd values = inputs;
    next_ = parameters_.data();
    for (std::size_t index = 0; index < layers_.size(); ++index) {
      if (const auto* dense = std::get_if<DenseLayer>(&layers_[index])) {
        values = forward(*dense, values);
      } else if (const auto* plain = std::get_if<RecurrentLayer>(&layers_[index])) {
        values = forward(*plain, values, &states_[index]);
      } else if (const auto* lstm = std::get_if<LstmLayer>(&layers_[index])) {
        values = forward(*lstm, values, &states_[index]);
      }
    }
    return values;
  }

 private:
  struct State {
    Eigen::VectorXd output;
    Eigen::VectorXd cell;
  };

  Eigen::MatrixXd take(Eigen::Index rows, Eigen::Index columns) {
    const double* values = next_;
    next_ += rows * columns;
    return Eigen::Map<const Eigen::MatrixXd>(values, rows, columns);
  }

  static Eigen::VectorXd activated(Activation activation, const Eigen::VectorXd& sums) {
    return sums.unaryExpr([activation](double x) {
      if (activation == Activation::kTanh) return std::tanh(x);
      if (activation == Activation::kSigmoid) return 1.0 / (1.0 + std::exp(-x));
      return activation == Activation::kRelu ? std::max(x, 0.0) : x;
    });
  }

  Eigen::VectorXd forward(const DenseLayer& layer, const Eigen::VectorXd& inputs) {
    const Eigen::MatrixXd weights = take(layer.weights.rows(), layer.weights.cols());
    return activated(layer.activation, weights * inputs + take(layer.weights.rows(), 1));
  }

  template <typename Recurrent>
  Eigen::VectorXd sums(const Recurrent& layer, const Eigen::VectorXd& inputs, State* state) {
    if (state->output.size() == 0) {
      state->output = state->cell = Eigen::VectorXd::Zero(layer.recurrent.cols());
    }
    const Eigen::MatrixXd input = take(layer.input.rows(), layer.input.cols());
    const Eigen::MatrixXd recurrent = take(layer.recurrent.rows(), layer.recurrent.cols());
    return input * inputs + recurrent * state->output + take(layer.input.rows(), 1);
  }

  Eigen::VectorXd forward(const RecurrentLayer& layer, const Eigen::VectorXd& inputs, State* state) {
    state->output = activated(Activation::kTanh, sums(layer, inputs, state));
    return state->output;
  }

  Eigen::VectorXd forward(const LstmLayer& layer, const Eigen::VectorXd& inputs, State* state) {
    const Eigen::VectorXd all = sums(layer, inputs, state);
    const Eigen::Index cells = layer.recurrent.cols();
    const Eigen::VectorXd gates = activated(Activation::kSigmoid, all.head(3 * cells));
    const Eigen::VectorXd candidate = activated(layer.candidate, all.tail(cells));
    state->cell = gates.tail(cells).cwiseProduct(state->cell) + gates.head(cells).cwiseProduct(candidate);
    state->output = activated(Activation::kTanh, state->cell).cwiseProduct(gates.segment(cells, cells));
    return state->output;
  }

  const LayerStack& layers_;
  const Eigen::VectorXd& parameters_;
  std::vector<State> states_;
  const double* next_ = nullptr;  ///< parameter
};

/// The loss of sequences, one after the other (thesis Eq. 2.6, 2.31).
inline double doubleLoss(const LayerStack& layers, const Eigen::VectorXd& parameters,
                         const std::vector<const Sequence*>& batch, Loss loss) {
  double sum = 0.0;
  for (const Sequence* sequence : batch) {
    DoubleNetwork network(layers, parameters);
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
