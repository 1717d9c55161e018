#include "network/onnx_layers.hpp"

#include "lstm_planner/network/model_file.hpp"

namespace lstm_planner::onnx {
namespace {

using onnx_subset::TensorProto;

struct GateWeights {
  Eigen::MatrixXf input;
  Eigen::MatrixXf recurrent;
  Eigen::VectorXf bias;
};

void requireShape(const Node& node, const TensorProto& tensor, const Shape& expected, const std::string& role) {
  const Shape shape = shapeOf(tensor);
  if (shape != expected) {
    throw ModelFileError(node.name() + " has " + role + " of the shape " + shapeText(shape) + ", expected " +
                         shapeText(expected));
  }
}

/// ONNX keeps two biases a gate, on the input's side and on the recurrent one, which are only ever used as a sum.
Eigen::VectorXf summedBias(const Node& node, std::int64_t rows) {
  const TensorProto* tensor = node.constant(3, "biases");
  if (tensor == nullptr) return Eigen::VectorXf::Zero(rows);
  requireShape(node, *tensor, {1, 2 * rows}, "biases");
  const std::vector<float> values = floatValues(*tensor);
  const Eigen::Map<const Eigen::VectorXf> both(values.data(), 2 * rows);
  return both.head(rows) + both.tail(rows);
}

/// Inputs and attributes that LSTM and RNN have in common.
GateWeights gateWeights(Node& node, std::int64_t gates, std::int64_t inputs) {
  const std::string direction = node.text("direction", "forward");
  if (direction != "forward") {
    throw ModelFileError(node.name() + " has the direction " + quoted(direction) + ", expected \"forward\"");
  }
  // The layouts differ in the place of two extents which are 1 here.
  node.integer("layout", 0);
  node.refuseInput(4, "sequence lengths");

  const TensorProto& input = node.requiredConstant(1, "input weights");
  const TensorProto& recurrent = node.requiredConstant(2, "recurrent weights");
  const Shape recurrent_shape = shapeOf(recurrent);
  const std::int64_t units = recurrent_shape.empty() ? 1 : recurrent_shape.back();
  requireShape(node, recurrent, {1, gates * units, units}, "recurrent weights");
  requireShape(node, input, {1, gates * units, inputs}, "input weights");
  node.requireInteger("hidden_size", units);
  return {rowMajorMatrix(floatValues(input), gates * units, inputs),
          rowMajorMatrix(floatValues(recurrent), gates * units, units), summedBias(node, gates * units)};
}

std::string listText(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + quoted(name);
  return "[" + text + "]";
}

}  // namespace

LstmLayer lstmLayer(Node& node, std::int64_t inputs) {
  using Names = std::vector<std::string>;
  const Names names = node.texts("activations", {"Sigmoid", "Tanh", "Tanh"});
  Activation candidate = Activation::kTanh;
  if (names == Names{"Sigmoid", "Sigmoid", "Tanh"}) {
    candidate = Activation::kSigmoid;
  } else if (names != Names{"Sigmoid", "Tanh", "Tanh"}) {
    throw ModelFileError(node.name() + " has the activations " + listText(names) +
                         ", expected Sigmoid for the gates, Tanh or Sigmoid for the candidate, Tanh for the output");
  }
  node.requireInteger("input_forget", 0);
  node.refuseInput(7, "peephole weights");
  GateWeights weights = gateWeights(node, 4, inputs);
  return {std::move(weights.input), std::move(weights.recurrent), std::move(weights.bias), candidate};
}

RecurrentLayer recurrentLayer(Node& node, std::int64_t inputs) {
  const std::vector<std::string> names = node.texts("activations", {"Tanh"});
  if (names != std::vector<std::string>{"Tanh"}) {
    throw ModelFileError(node.name() + " has the activations " + listText(names) + ", expected Tanh");
  }
  GateWeights weights = gateWeights(node, 1, inputs);
  return {std::move(weights.input), std::move(weights.recurrent), std::move(weights.bias)};
}

DenseLayer denseLayer(Node& node, std::int64_t inputs) {
  node.requireReal("alpha", 1.0f);
  node.requireReal("beta", 1.0f);
  node.requireInteger("transA", 0);
  DenseLayer layer = productLayer(node, inputs, node.integer("transB", 0) != 0);
  const std::int64_t outputs = layer.weights.rows();
  if (const TensorProto* bias = node.constant(2, "biases")) {
    requireShape(node, *bias, bias->dims_size() == 1 ? Shape{outputs} : Shape{1, outputs}, "biases");
    layer.bias = rowMajorMatrix(floatValues(*bias), outputs, 1);
  }
  return layer;
}

DenseLayer productLayer(const Node& node, std::int64_t inputs, bool transposed) {
  const TensorProto& weights = node.requiredConstant(1, "weights");
  const Shape shape = shapeOf(weights);
  if (shape.size() != 2 || shape[transposed ? 1 : 0] != inputs) {
    throw ModelFileError(node.name() + " has weights of the shape " + shapeText(shape) + ", expected two axes and " +
                         std::to_string(inputs) + " inputs");
  }
  DenseLayer layer;
  layer.weights = rowMajorMatrix(floatValues(weights), shape[0], shape[1]);
  if (!transposed) layer.weights.transposeInPlace();
  layer.bias = Eigen::VectorXf::Zero(layer.weights.rows());
  return layer;
}

Eigen::VectorXf biases(const Node& node, int index, std::int64_t outputs) {
  const TensorProto& bias = node.requiredConstant(index, "biases");
  const Shape shape = shapeOf(bias);
  if (shape.empty() || shape.back() != outputs || elementCount(shape, node.name()) != outputs) {
    throw ModelFileError(node.name() + " has biases of the shape " + shapeText(shape) + ", expected " +
                         std::to_string(outputs) + " along the last axis");
  }
  return rowMajorMatrix(floatValues(bias), outputs, 1);
}

}  // namespace lstm_planner::onnx
