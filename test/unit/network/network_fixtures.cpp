#include "unit/network/network_fixtures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

namespace lstm_planner::test {
namespace {

using Doubles = std::vector<double>;

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

double rowTimes(const Eigen::MatrixXf& matrix, int row, const Doubles& values) {
  double sum = 0.0;
  for (std::size_t column = 0; column < values.size(); ++column) {
    sum += static_cast<double>(matrix(row, static_cast<int>(column))) * values[column];
  }
  return sum;
}

Doubles lstmStep(const LstmLayer& layer, const Doubles& input, Doubles& hidden, Doubles& cell) {
  const int cells = static_cast<int>(layer.recurrent.cols());
  const Doubles previous = hidden;
  const auto weightedSum = [&](int gate, int unit) {
    const int row = gate * cells + unit;
    return rowTimes(layer.input, row, input) + rowTimes(layer.recurrent, row, previous) + double(layer.bias(row));
  };
  for (int unit = 0; unit < cells; ++unit) {
    const double input_gate = sigmoid(weightedSum(0, unit));
    const double output_gate = sigmoid(weightedSum(1, unit));
    const double forget_gate = sigmoid(weightedSum(2, unit));
    const double candidate = activated(layer.candidate, weightedSum(3, unit));
    cell[unit] = forget_gate * cell[unit] + input_gate * candidate;
    hidden[unit] = std::tanh(cell[unit]) * output_gate;
  }
  return hidden;
}

Doubles recurrentStep(const RecurrentLayer& layer, const Doubles& input, Doubles& hidden) {
  const Doubles previous = hidden;
  for (int unit = 0; unit < layer.bias.size(); ++unit) {
    hidden[unit] = std::tanh(rowTimes(layer.input, unit, input) + rowTimes(layer.recurrent, unit, previous) +
                             double(layer.bias(unit)));
  }
  return hidden;
}

Doubles denseStep(const DenseLayer& layer, const Doubles& input) {
  Doubles output;
  for (int unit = 0; unit < layer.bias.size(); ++unit) {
    output.push_back(activated(layer.activation, rowTimes(layer.weights, unit, input) + double(layer.bias(unit))));
  }
  return output;
}

Doubles softmax(const Doubles& input) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const double value : input) largest = std::max(largest, value);
  double sum = 0.0;
  for (const double value : input) sum += std::exp(value - largest);
  Doubles output;
  for (const double value : input) output.push_back(std::exp(value - largest) / sum);
  return output;
}

}  // namespace

ReferenceNetwork::ReferenceNetwork(LayerStack layers) : layers_(std::move(layers)) {
  for (const Layer& layer : layers_) {
    std::size_t units = 0;
    if (const auto* lstm = std::get_if<LstmLayer>(&layer)) units = lstm->recurrent.cols();
    if (const auto* recurrent = std::get_if<RecurrentLayer>(&layer)) units = recurrent->recurrent.cols();
    states_.push_back({Doubles(units, 0.0), Doubles(units, 0.0)});
  }
}

std::vector<double> ReferenceNetwork::forward(const Eigen::VectorXf& input) {
  Doubles values(input.data(), input.data() + input.size());
  for (std::size_t index = 0; index < layers_.size(); ++index) {
    State& state = states_[index];
    const Layer& layer = layers_[index];
    if (const auto* lstm = std::get_if<LstmLayer>(&layer)) {
      values = lstmStep(*lstm, values, state.hidden, state.cell);
    } else if (const auto* recurrent = std::get_if<RecurrentLayer>(&layer)) {
      values = recurrentStep(*recurrent, values, state.hidden);
    } else if (const auto* dense = std::get_if<DenseLayer>(&layer)) {
      values = denseStep(*dense, values);
    } else {
      values = softmax(values);
    }
  }
  return values;
}

double largestDifference(const Eigen::VectorXf& values, const std::vector<double>& reference) {
  if (values.size() != static_cast<Eigen::Index>(reference.size()) || !values.allFinite()) {
    return std::numeric_limits<double>::infinity();
  }
  double largest = 0.0;
  for (std::size_t index = 0; index < reference.size(); ++index) {
    largest = std::max(largest, std::abs(double(values(static_cast<int>(index))) - reference[index]));
  }
  return largest;
}

}  // namespace lstm_planner::test
