#pragma once

#include <Eigen/Core>
#include <vector>

#include "lstm_planner/base/network/layers.hpp"

namespace lstm_planner {

/// A network of LSTM layers and a dense one as one writes it down from the equations with Eigen: what the kernels of
/// Network are compared with. Compiled like everything else, without instructions of one machine.
class TextbookLstm {
 public:
  /// `layers` are LSTMs with a tanh and, at the end, a dense layer without activation.
  explicit TextbookLstm(const LayerStack& layers) : dense_(std::get<DenseLayer>(layers.back())) {
    for (std::size_t i = 0; i + 1 < layers.size(); ++i) {
      layers_.push_back(std::get<LstmLayer>(layers[i]));
      outputs_.push_back(Eigen::VectorXf::Zero(layers_.back().recurrent.cols()));
      cells_.push_back(outputs_.back());
    }
  }

  Eigen::VectorXf forward(Eigen::VectorXf x) {
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      const LstmLayer& layer = layers_[i];
      const Eigen::Index n = cells_[i].size();
      const Eigen::VectorXf sums = layer.input * x + layer.recurrent * outputs_[i] + layer.bias;
      const Eigen::VectorXf input_gate = sigmoid(sums.segment(0, n));
      const Eigen::VectorXf output_gate = sigmoid(sums.segment(n, n));
      const Eigen::VectorXf forget_gate = sigmoid(sums.segment(2 * n, n));
      const Eigen::VectorXf candidate = sums.segment(3 * n, n).array().tanh();
      cells_[i] = forget_gate.cwiseProduct(cells_[i]) + input_gate.cwiseProduct(candidate);
      outputs_[i] = output_gate.cwiseProduct(Eigen::VectorXf(cells_[i].array().tanh()));
      x = outputs_[i];
    }
    return dense_.weights * x + dense_.bias;
  }

 private:
  static Eigen::VectorXf sigmoid(const Eigen::VectorXf& x) { return 1.0f / (1.0f + (-x.array()).exp()); }

  std::vector<LstmLayer> layers_;
  DenseLayer dense_;
  std::vector<Eigen::VectorXf> outputs_;
  std::vector<Eigen::VectorXf> cells_;
};

}  // namespace lstm_planner
