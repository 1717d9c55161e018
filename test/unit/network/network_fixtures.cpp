#include "unit/network/network_fixtures.hpp"

#include <cmath>
#include <limits>
#include <variant>

#include "lstm_planner/training/parameter_vector.hpp"

namespace lstm_planner::test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

double sigmoid(double value) { return 1.0 / (1.0 + std::exp(-value)); }

double activated(Activation activation, double value) {
  switch (activation) {
    case Activation::kTanh:
      return std::tanh(value);
    case Activation::kSigmoid:
      return sigmoid(value);
    case Activation::kRelu:
      return value > 0.0 ? value : 0.0;
    case Activation::kIdentity:
      return value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double rowTimes(const Eigen::MatrixXd& matrix, Index row, const VectorXd& values) {
  double sum = 0.0;
  for (Index column = 0; column < matrix.cols(); ++column) sum += matrix(row, column) * values[column];
  return sum;
}

VectorXd softmax(const VectorXd& input) {
  const double largest = input.maxCoeff();
  double sum = 0.0;
  for (Index i = 0; i < input.size(); ++i) sum += std::exp(input[i] - largest);
  VectorXd output(input.size());
  for (Index i = 0; i < input.size(); ++i) output[i] = std::exp(input[i] - largest) / sum;
  return output;
}

}  // namespace

double ReferenceNetwork::LayerInDouble::weightedSum(Index row, const VectorXd& inputs, const VectorXd& previous) const {
  return rowTimes(input, row, inputs) + rowTimes(recurrent, row, previous) + bias[row];
}

void ReferenceNetwork::LayerInDouble::stepLstm(Activation candidate_activation, const VectorXd& inputs) {
  const VectorXd previous = hidden;
  const Index cells = hidden.size();
  for (Index unit = 0; unit < cells; ++unit) {
    const double input_gate = sigmoid(weightedSum(unit, inputs, previous));
    const double output_gate = sigmoid(weightedSum(cells + unit, inputs, previous));
    const double forget_gate = sigmoid(weightedSum(2 * cells + unit, inputs, previous));
    const double candidate = activated(candidate_activation, weightedSum(3 * cells + unit, inputs, previous));
    cell[unit] = forget_gate * cell[unit] + input_gate * candidate;
    hidden[unit] = std::tanh(cell[unit]) * output_gate;
  }
}

void ReferenceNetwork::LayerInDouble::stepRecurrent(const VectorXd& inputs) {
  const VectorXd previous = hidden;
  for (Index unit = 0; unit < hidden.size(); ++unit) hidden[unit] = std::tanh(weightedSum(unit, inputs, previous));
}

VectorXd ReferenceNetwork::LayerInDouble::dense(Activation activation, const VectorXd& inputs) const {
  VectorXd output(bias.size());
  for (Index unit = 0; unit < bias.size(); ++unit) {
    output[unit] = activated(activation, rowTimes(input, unit, inputs) + bias[unit]);
  }
  return output;
}

ReferenceNetwork::ReferenceNetwork(const LayerStack& layers)
    : ReferenceNetwork(layers, parameterVector(layers).cast<double>()) {}

ReferenceNetwork::ReferenceNetwork(const LayerStack& layers, const VectorXd& parameters) {
  const double* next = parameters.data();
  const auto take = [&next](const auto& like) -> Eigen::MatrixXd {
    const double* const first = next;
    next += like.size();
    return Eigen::Map<const Eigen::MatrixXd>(first, like.rows(), like.cols());
  };
  const auto takeRecurrent = [&](const auto& layer, LayerInDouble* in_double) {
    in_double->input = take(layer.input);
    in_double->recurrent = take(layer.recurrent);
    in_double->bias = take(layer.bias);
    in_double->hidden = in_double->cell = VectorXd::Zero(layer.recurrent.cols());
  };
  for (const Layer& layer : layers) {
    LayerInDouble in_double;
    in_double.layer = layer;
    if (const auto* lstm = std::get_if<LstmLayer>(&layer)) takeRecurrent(*lstm, &in_double);
    if (const auto* recurrent = std::get_if<RecurrentLayer>(&layer)) takeRecurrent(*recurrent, &in_double);
    if (const auto* dense = std::get_if<DenseLayer>(&layer)) {
      in_double.input = take(dense->weights);
      in_double.bias = take(dense->bias);
    }
    layers_.push_back(in_double);
  }
}

VectorXd ReferenceNetwork::forward(const VectorXd& input) {
  VectorXd values = input;
  for (LayerInDouble& layer : layers_) {
    if (const auto* dense = std::get_if<DenseLayer>(&layer.layer)) {
      values = layer.dense(dense->activation, values);
    } else if (std::holds_alternative<SoftmaxLayer>(layer.layer)) {
      values = softmax(values);
    } else {
      const auto* lstm = std::get_if<LstmLayer>(&layer.layer);
      lstm != nullptr ? layer.stepLstm(lstm->candidate, values) : layer.stepRecurrent(values);
      values = layer.hidden;
    }
  }
  return values;
}

double largestDifference(const Eigen::VectorXf& values, const VectorXd& reference) {
  if (values.size() != reference.size() || !values.allFinite()) return std::numeric_limits<double>::infinity();
  return (values.cast<double>() - reference).cwiseAbs().maxCoeff();
}

}  // namespace lstm_planner::test
