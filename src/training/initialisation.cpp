#include "lstm_planner/training/initialisation.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "lstm_planner/common/parameter_check.hpp"
#include "lstm_planner/common/random.hpp"

namespace lstm_planner {
namespace {

class WeightSource {
 public:
  WeightSource(const InitialisationParameters& parameters, std::uint64_t seed)
      : parameters_(parameters), random_(seed) {}

  /// `outputs` counts the units of one gate: a gate's weights are as large as if it were a layer of its own.
  void fill(Eigen::Index outputs, Eigen::MatrixXf& weights) {
    const double fans = static_cast<double>(weights.cols() + outputs);
    const double range = parameters_.range.value_or(std::sqrt(6.0 / fans));
    for (Eigen::Index column = 0; column < weights.cols(); ++column) {
      for (Eigen::Index row = 0; row < weights.rows(); ++row) {
        weights(row, column) = static_cast<float>(uniform(random_, -range, range));
      }
    }
  }

 private:
  const InitialisationParameters& parameters_;
  Random random_;
};

void requireSizes(int inputs, const std::vector<int>& hidden, int outputs) {
  std::vector<int> sizes = hidden;
  sizes.insert(sizes.begin(), inputs);
  sizes.push_back(outputs);
  for (const int size : sizes) {
    if (size < 1) throw std::invalid_argument("layer size is " + std::to_string(size) + ", expected at least 1");
  }
}

void requireLayersOf(const NetworkShape& shape) {
  const bool perceptron = shape.kind == NetworkShape::Kind::kMlp;
  const bool deep = !(shape.deep_in.empty() && shape.deep_out.empty());
  if (shape.cells.empty()) throw std::invalid_argument("a network has no cells, expected at least one layer of them");
  if (perceptron && deep) {
    throw std::invalid_argument(
        "an mlp has deep-in or deep-out layers, expected none: it has no recurrent layer that they are before or "
        "behind");
  }
  if (shape.activation == Activation::kIdentity) {
    throw std::invalid_argument("a network's dense layers have no activation, expected tanh, sigmoid or relu");
  }
  if (shape.activation != Activation::kTanh && !perceptron && !deep) {
    throw std::invalid_argument("a network has an activation of dense layers, but no dense layer besides the last");
  }
  if (shape.candidate != Activation::kTanh && shape.kind != NetworkShape::Kind::kLstm) {
    throw std::invalid_argument("a network has a candidate that is not tanh, but no LSTM layer");
  }
}

/// Appends fully connected layers. `width`: of what comes in, then of what the last of them puts out.
void appendDense(const std::vector<int>& units, Activation activation, int* width, LayerStack* layers) {
  for (const int count : units) {
    layers->push_back(DenseLayer{Eigen::MatrixXf::Zero(count, *width), Eigen::VectorXf::Zero(count), activation});
    *width = count;
  }
}

}  // namespace

LayerStack initialised(LayerStack layers, std::uint64_t seed, const InitialisationParameters& parameters) {
  if (parameters.range) checkPositive("range", *parameters.range);
  if (!std::isfinite(parameters.forget_gate_bias)) {
    throw std::invalid_argument("forget_gate_bias is not finite, expected a number");
  }
  WeightSource source(parameters, seed);
  for (Layer& layer : layers) {
    if (auto* lstm = std::get_if<LstmLayer>(&layer)) {
      const Eigen::Index cells = lstm->recurrent.cols();
      source.fill(cells, lstm->input);
      source.fill(cells, lstm->recurrent);
      lstm->bias.setZero();
      lstm->bias.segment(2 * cells, cells).setConstant(static_cast<float>(parameters.forget_gate_bias));
    } else if (auto* recurrent = std::get_if<RecurrentLayer>(&layer)) {
      source.fill(recurrent->input.rows(), recurrent->input);
      source.fill(recurrent->recurrent.rows(), recurrent->recurrent);
      recurrent->bias.setZero();
    } else if (auto* dense = std::get_if<DenseLayer>(&layer)) {
      source.fill(dense->weights.rows(), dense->weights);
      dense->bias.setZero();
    }
  }
  return layers;
}

LayerStack makeLstmStack(int inputs, const std::vector<int>& cells, int outputs, Activation candidate) {
  NetworkShape shape;
  shape.cells = cells;
  shape.candidate = candidate;
  return makeNetwork(inputs, shape, outputs);
}

LayerStack makeDenseStack(int inputs, const std::vector<int>& units, int outputs) {
  requireSizes(inputs, units, outputs);
  LayerStack layers;
  appendDense(units, Activation::kTanh, &inputs, &layers);
  appendDense({outputs}, Activation::kIdentity, &inputs, &layers);
  return layers;
}

LayerStack makeNetwork(int inputs, const NetworkShape& shape, int outputs) {
  requireLayersOf(shape);
  std::vector<int> sizes = shape.deep_in;
  sizes.insert(sizes.end(), shape.cells.begin(), shape.cells.end());
  sizes.insert(sizes.end(), shape.deep_out.begin(), shape.deep_out.end());
  requireSizes(inputs, sizes, outputs);
  LayerStack layers;
  appendDense(shape.deep_in, shape.activation, &inputs, &layers);
  for (const int count : shape.cells) {
    const int rows = shape.kind == NetworkShape::Kind::kLstm ? 4 * count : count;
    const Eigen::MatrixXf input = Eigen::MatrixXf::Zero(rows, inputs);
    const Eigen::MatrixXf state = Eigen::MatrixXf::Zero(rows, count);
    const Eigen::VectorXf bias = Eigen::VectorXf::Zero(rows);
    if (shape.kind == NetworkShape::Kind::kLstm) layers.push_back(LstmLayer{input, state, bias, shape.candidate});
    if (shape.kind == NetworkShape::Kind::kRnn) layers.push_back(RecurrentLayer{input, state, bias});
    if (shape.kind == NetworkShape::Kind::kMlp) layers.push_back(DenseLayer{input, bias, shape.activation});
    inputs = count;
  }
  appendDense(shape.deep_out, shape.activation, &inputs, &layers);
  appendDense({outputs}, Activation::kIdentity, &inputs, &layers);
  return layers;
}

}  // namespace lstm_planner
