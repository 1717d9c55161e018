#include "lstm_planner/network/network.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace lstm_planner {
namespace {

using Eigen::Index;
using Eigen::VectorXf;
using Values = Eigen::Ref<VectorXf>;
using ConstValues = Eigen::Ref<const VectorXf>;

/// Width of a layer's weighted sums, of its part of the hidden state, and of its output.
struct LayerWidths {
  Index weighted_sums;
  Index state;
  Index output;
};

LayerWidths widths(const LstmLayer& layer, Index /*inputs*/) {
  const Index cells = layer.recurrent.cols();
  return {4 * cells, 2 * cells, cells};
}
LayerWidths widths(const RecurrentLayer& layer, Index /*inputs*/) {
  const Index units = layer.recurrent.cols();
  return {units, units, units};
}
LayerWidths widths(const DenseLayer& layer, Index /*inputs*/) {
  return {layer.weights.rows(), 0, layer.weights.rows()};
}
LayerWidths widths(const SoftmaxLayer&, Index inputs) { return {inputs, 0, inputs}; }

/// exp(-x) overflows to infinity for very negative x, and 1 / infinity is the correct limit 0.
void applySigmoid(Values values) { values.array() = 1.0f / (1.0f + (-values.array()).exp()); }

void applyActivation(Activation activation, Values values) {
  switch (activation) {
    case Activation::kIdentity:
      return;
    case Activation::kTanh:
      values.array() = values.array().tanh();
      return;
    case Activation::kSigmoid:
      applySigmoid(values);
      return;
    case Activation::kRelu:
      values = values.cwiseMax(0.0f);
      return;
  }
}

/// Eigen's vectorised exp turns NaN into a number, so a sum that overflowed must be found before its activation.
void requireFinite(const VectorXf& weighted_sums) {
  if (!weighted_sums.allFinite()) {
    throw std::invalid_argument("the network's input is too large: a weighted sum of it is not finite");
  }
}

void step(const LstmLayer& layer, const ConstValues& input, const ConstValues& state, Values next_state,
          VectorXf& gates, VectorXf& output) {
  const Index cells = layer.recurrent.cols();
  gates = layer.bias;
  gates.noalias() += layer.input * input;
  gates.noalias() += layer.recurrent * state.head(cells);
  requireFinite(gates);

  applySigmoid(gates.head(3 * cells));
  applyActivation(layer.candidate, gates.tail(cells));
  const auto input_gate = gates.segment(0, cells).array();
  const auto output_gate = gates.segment(cells, cells).array();
  const auto forget_gate = gates.segment(2 * cells, cells).array();
  const auto candidate = gates.segment(3 * cells, cells).array();

  auto next_cell = next_state.tail(cells).array();
  next_cell = forget_gate * state.tail(cells).array() + input_gate * candidate;
  output.array() = next_cell.tanh() * output_gate;
  next_state.head(cells) = output;
}

void step(const RecurrentLayer& layer, const ConstValues& input, const ConstValues& state, Values next_state,
          VectorXf& weighted_sums, VectorXf& output) {
  weighted_sums = layer.bias;
  weighted_sums.noalias() += layer.input * input;
  weighted_sums.noalias() += layer.recurrent * state;
  requireFinite(weighted_sums);
  output.array() = weighted_sums.array().tanh();
  next_state = output;
}

void step(const DenseLayer& layer, const ConstValues& input, const ConstValues& /*state*/, Values /*next_state*/,
          VectorXf& weighted_sums, VectorXf& output) {
  weighted_sums = layer.bias;
  weighted_sums.noalias() += layer.weights * input;
  requireFinite(weighted_sums);
  applyActivation(layer.activation, weighted_sums);
  output = weighted_sums;
}

/// Probabilities are the same for preferences shifted by a constant; with the largest at 0 no exp overflows.
void step(const SoftmaxLayer&, const ConstValues& input, const ConstValues& /*state*/, Values /*next_state*/,
          VectorXf& weighted_sums, VectorXf& output) {
  weighted_sums.array() = (input.array() - input.maxCoeff()).exp();
  output = weighted_sums / weighted_sums.sum();
}

}  // namespace

Network::Network(LayerStack layers) : layers_(std::move(layers)) {
  validateLayers(layers_);
  input_size_ = lstm_planner::inputSize(layers_);
  output_size_ = lstm_planner::outputSize(layers_);
  Index inputs = input_size_;
  Index state_size = 0;
  for (const Layer& layer : layers_) {
    const LayerWidths width = std::visit([&](const auto& typed) { return widths(typed, inputs); }, layer);
    workspaces_.push_back({state_size, width.state, VectorXf::Zero(width.weighted_sums), VectorXf::Zero(width.output)});
    state_size += width.state;
    inputs = width.output;
  }
  hidden_state_ = HiddenState::Zero(state_size);
  next_hidden_state_ = hidden_state_;
}

const VectorXf& Network::forward(const ConstValues& input) {
  if (input.size() != input_size_) {
    throw std::invalid_argument("the network's input has " + std::to_string(input.size()) + " values, expected " +
                                std::to_string(input_size_));
  }
  if (!input.allFinite()) throw std::invalid_argument("the network's input holds a value that is not finite");

  const float* values = input.data();
  Index size = input.size();
  for (std::size_t index = 0; index < layers_.size(); ++index) {
    Workspace& workspace = workspaces_[index];
    const Eigen::Map<const VectorXf> layer_input(values, size);
    const auto state = hidden_state_.segment(workspace.state_offset, workspace.state_size);
    auto next_state = next_hidden_state_.segment(workspace.state_offset, workspace.state_size);
    std::visit(
        [&](const auto& layer) {
          step(layer, layer_input, state, next_state, workspace.weighted_sums, workspace.output);
        },
        layers_[index]);
    values = workspace.output.data();
    size = workspace.output.size();
  }
  hidden_state_.swap(next_hidden_state_);
  return workspaces_.back().output;
}

void Network::reset() { hidden_state_.setZero(); }

void Network::setHiddenState(const HiddenState& state) {
  if (state.size() != hidden_state_.size()) {
    throw std::invalid_argument("the hidden state has " + std::to_string(state.size()) + " values, expected " +
                                std::to_string(hidden_state_.size()));
  }
  if (!state.allFinite()) throw std::invalid_argument("the hidden state holds a value that is not finite");
  hidden_state_ = state;
}

}  // namespace lstm_planner
