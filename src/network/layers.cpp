#include "lstm_planner/network/layers.hpp"

#include <stdexcept>
#include <string>

namespace lstm_planner {
namespace {

using Eigen::Index;

constexpr Index kAnyWidth = 0;  ///< of a softmax, which takes the width of the layer before it

Index inputWidth(const LstmLayer& layer) { return layer.input.cols(); }
Index inputWidth(const RecurrentLayer& layer) { return layer.input.cols(); }
Index inputWidth(const DenseLayer& layer) { return layer.weights.cols(); }
Index inputWidth(const SoftmaxLayer&) { return kAnyWidth; }

Index outputWidth(const LstmLayer& layer) { return layer.recurrent.cols(); }
Index outputWidth(const RecurrentLayer& layer) { return layer.recurrent.cols(); }
Index outputWidth(const DenseLayer& layer) { return layer.weights.rows(); }
Index outputWidth(const SoftmaxLayer&) { return kAnyWidth; }

const char* kind(const LstmLayer&) { return "LSTM"; }
const char* kind(const RecurrentLayer&) { return "recurrent"; }
const char* kind(const DenseLayer&) { return "dense"; }
const char* kind(const SoftmaxLayer&) { return "softmax"; }

Index weightCount(const LstmLayer& layer) { return layer.input.size() + layer.recurrent.size() + layer.bias.size(); }
Index weightCount(const RecurrentLayer& layer) {
  return layer.input.size() + layer.recurrent.size() + layer.bias.size();
}
Index weightCount(const DenseLayer& layer) { return layer.weights.size() + layer.bias.size(); }
Index weightCount(const SoftmaxLayer&) { return 0; }

std::string shapeText(Index rows, Index columns) { return std::to_string(rows) + " x " + std::to_string(columns); }

void requireWeights(const std::string& what, const Eigen::Ref<const Eigen::MatrixXf>& weights, Index rows,
                    Index columns) {
  if (weights.rows() != rows || weights.cols() != columns) {
    throw std::invalid_argument(what + " are " + shapeText(weights.rows(), weights.cols()) + ", expected " +
                                shapeText(rows, columns));
  }
  if (!weights.allFinite()) throw std::invalid_argument(what + " hold a value that is not finite");
}

void requireNotEmpty(const std::string& name, Index inputs, Index outputs) {
  if (inputs == 0) throw std::invalid_argument(name + " has no inputs, expected at least one");
  if (outputs == 0) throw std::invalid_argument(name + " has no outputs, expected at least one");
}

void requireGates(const std::string& name, const Eigen::MatrixXf& input, const Eigen::MatrixXf& recurrent,
                  const Eigen::VectorXf& bias, Index gates) {
  const Index units = recurrent.cols();
  requireNotEmpty(name, input.cols(), units);
  requireWeights(name + ": recurrent weights", recurrent, gates * units, units);
  requireWeights(name + ": input weights", input, gates * units, input.cols());
  requireWeights(name + ": biases", bias, gates * units, 1);
}

void validate(const LstmLayer& layer, const std::string& name) {
  requireGates(name, layer.input, layer.recurrent, layer.bias, 4);
  if (layer.candidate != Activation::kTanh && layer.candidate != Activation::kSigmoid) {
    throw std::invalid_argument(name + ": the candidate's activation is neither tanh nor sigmoid");
  }
}

void validate(const RecurrentLayer& layer, const std::string& name) {
  requireGates(name, layer.input, layer.recurrent, layer.bias, 1);
}

void validate(const DenseLayer& layer, const std::string& name) {
  requireNotEmpty(name, layer.weights.cols(), layer.weights.rows());
  requireWeights(name + ": weights", layer.weights, layer.weights.rows(), layer.weights.cols());
  requireWeights(name + ": biases", layer.bias, layer.weights.rows(), 1);
}

void validate(const SoftmaxLayer&, const std::string&) {}

}  // namespace

std::size_t countWeights(const LayerStack& layers) {
  std::size_t count = 0;
  for (const Layer& layer : layers) {
    count += static_cast<std::size_t>(std::visit([](const auto& typed) { return weightCount(typed); }, layer));
  }
  return count;
}

int inputSize(const LayerStack& layers) {
  const Index width =
      layers.empty() ? kAnyWidth : std::visit([](const auto& typed) { return inputWidth(typed); }, layers.front());
  if (width == kAnyWidth) throw std::invalid_argument("the network has no first layer with weights, expected one");
  return static_cast<int>(width);
}

int outputSize(const LayerStack& layers) {
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
    const Index width = std::visit([](const auto& typed) { return outputWidth(typed); }, *layer);
    if (width != kAnyWidth) return static_cast<int>(width);
  }
  throw std::invalid_argument("the network has no layer with weights, expected at least one");
}

void validateLayers(const LayerStack& layers) {
  if (layers.empty()) throw std::invalid_argument("the network has no layers, expected at least one");
  Index width = kAnyWidth;
  for (std::size_t index = 0; index < layers.size(); ++index) {
    std::visit(
        [&](const auto& layer) {
          const std::string name = "layer " + std::to_string(index + 1) + " (" + kind(layer) + ")";
          validate(layer, name);
          const Index inputs = inputWidth(layer);
          if (index == 0 && inputs == kAnyWidth) {
            throw std::invalid_argument(name + " is the first layer, expected one with weights before it");
          }
          if (index > 0 && inputs != kAnyWidth && inputs != width) {
            throw std::invalid_argument(name + " takes " + std::to_string(inputs) +
                                        " values, but the layer before it gives " + std::to_string(width));
          }
          if (outputWidth(layer) != kAnyWidth) width = outputWidth(layer);
        },
        layers[index]);
  }
}

}  // namespace lstm_planner
