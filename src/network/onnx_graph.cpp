#include "network/onnx_graph.hpp"

#include <algorithm>
#include <utility>

#include "lstm_planner/common/words.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "network/onnx_layers.hpp"
#include "network/onnx_names.hpp"
#include "network/onnx_shapes.hpp"

namespace lstm_planner::onnx {
namespace {

// Far above any net that runs at each scan.
constexpr std::size_t kMaximumLayers = 256;
constexpr std::size_t kMaximumWeights = std::size_t{1} << 24;

/// The states of several recurrent layers in one value, as PyTorch has them: layer, robot, unit.
bool isStackOfStates(const Shape& shape) { return shape.size() == 3 && shape[0] > 1 && shape[1] == 1; }

}  // namespace

bool isStandardDomain(const std::string& domain) { return domain.empty() || domain == "ai.onnx"; }

const std::map<std::string, GraphReader::ReadNode>& GraphReader::operators() {
  static const std::map<std::string, ReadNode> all = {
      {"Add", &GraphReader::readAdd},
      {"Concat", &GraphReader::readConcat},
      {"Constant", &GraphReader::readConstant},
      {"Flatten", &GraphReader::readShapeNode},
      {"Gather", &GraphReader::readShapeNode},
      {"Gemm", &GraphReader::readGemm},
      {"Identity", &GraphReader::readShapeNode},
      {"LSTM", &GraphReader::readLstm},
      {"MatMul", &GraphReader::readMatMul},
      {"RNN", &GraphReader::readRnn},
      {"Shape", &GraphReader::readShape},
      {"Relu", &GraphReader::readActivation},
      {"Reshape", &GraphReader::readShapeNode},
      {"Sigmoid", &GraphReader::readActivation},
      {"Slice", &GraphReader::readSlice},
      {"Softmax", &GraphReader::readSoftmax},
      {"Squeeze", &GraphReader::readShapeNode},
      {"Tanh", &GraphReader::readActivation},
      {"Transpose", &GraphReader::readShapeNode},
      {"Unsqueeze", &GraphReader::readShapeNode},
  };
  return all;
}

LayerStack GraphReader::read() {
  for (const auto& tensor : graph_.initializer()) addConstant(tensor.name(), tensor);
  std::string faults = unknownOperators();
  for (const auto& input : graph_.input()) {
    // Old files list the stored tensors among the inputs.
    if (constants_.count(input.name()) > 0) continue;
    try {
      addGraphInput(input);
    } catch (const ModelFileError& error) {
      faults += (faults.empty() ? "" : "; ") + std::string(error.what());
    }
  }
  if (!faults.empty()) throw ModelFileError(faults);
  for (const auto& node : graph_.node()) readNode(node);
  requireOutputs();
  return std::move(layers_);
}

/// What the operators are that the planner does not know; empty where there is none.
std::string GraphReader::unknownOperators() const {
  std::set<std::string> unknown;
  for (const auto& node : graph_.node()) {
    const bool is_standard = isStandardDomain(node.domain());
    if (is_standard && (operators().count(node.op_type()) > 0 || isFoldable(node.op_type()))) continue;
    unknown.insert(quoted(node.op_type()) + (is_standard ? "" : " of the domain " + quoted(node.domain())));
  }
  if (unknown.empty()) return "";
  const std::string listed = joined({unknown.begin(), unknown.end()});
  return (unknown.size() == 1 ? "the operator " + listed + " is" : "the operators " + listed + " are") +
         " not known to the planner, expected LSTM, RNN, Gemm, MatMul with Add, Relu, Tanh, Sigmoid, Softmax or one "
         "that "
         "changes only the shape";
}

void GraphReader::addConstant(const std::string& name, const onnx_subset::TensorProto& tensor) {
  if (values_.count(name) > 0 || !constants_.emplace(name, &tensor).second) {
    throw ModelFileError("the value " + quoted(name) + " is defined twice, expected once");
  }
}

void GraphReader::addGraphInput(const onnx_subset::ValueInfoProto& input) {
  const std::string name = "graph input " + quoted(input.name());
  const auto& type = input.type().tensor_type();
  if (type.elem_type() != kFloat) {
    throw ModelFileError(name + " has the data type " + std::to_string(type.elem_type()) + ", expected " +
                         std::to_string(kFloat) + " (float)");
  }
  if (!type.has_shape()) throw ModelFileError(name + " has no shape, expected one");
  Shape shape;
  for (const auto& extent : type.shape().dim()) shape.push_back(extent.has_dim_value() ? extent.dim_value() : 1);
  elementCount(shape, name);
  if (!isStackOfStates(shape)) requireVector(shape, name);
  define(input.name(), {shape, 0, false, input.name()});
}

void GraphReader::define(const std::string& name, const Value& value) {
  if (name.empty()) return;
  if (constants_.count(name) > 0 || !values_.emplace(name, value).second) {
    throw ModelFileError("the value " + quoted(name) + " is defined twice, expected once");
  }
}

const GraphReader::Value& GraphReader::valueNamed(const std::string& name, const std::string& user) const {
  const auto found = values_.find(name);
  if (found == values_.end()) {
    throw ModelFileError(user + " takes " + quoted(name) +
                         ", expected a graph input or the result of a node before it");
  }
  return found->second;
}

void GraphReader::readNode(const onnx_subset::NodeProto& proto) {
  Node node(proto, constants_);
  if (isConstant(proto)) {
    fold(node);
    return node.finish();
  }
  const auto found = operators().find(proto.op_type());
  if (found == operators().end()) {
    throw ModelFileError(node.name() + " computes something, expected it to change or make constants only");
  }
  (this->*found->second)(node);
  node.finish();
}

/// Whether it is all told by what is stored in the file.
bool GraphReader::isConstant(const onnx_subset::NodeProto& node) const {
  const auto is_stored = [this](const std::string& input) { return input.empty() || constants_.count(input) > 0; };
  return isStandardDomain(node.domain()) && isFoldable(node.op_type()) && node.input_size() > 0 &&
         std::all_of(node.input().begin(), node.input().end(), is_stored);
}

void GraphReader::fold(Node& node) {
  folded_.push_back(folded(node, opset_, &folding_room_));
  folded_.back().set_name(node.output(0));
  addConstant(node.output(0), folded_.back());
}

void GraphReader::readShape(Node& node) {
  const Shape shape = valueNamed(node.input(0), node.name()).shape;
  folded_.push_back(emptyTensor(kInt64, {static_cast<std::int64_t>(shape.size())}));
  for (const std::int64_t extent : shape) folded_.back().add_int64_data(extent);
  addConstant(node.output(0), folded_.back());
}

void GraphReader::readConstant(Node& node) {
  const onnx_subset::TensorProto* tensor = node.tensor("value");
  if (tensor == nullptr) throw ModelFileError(node.name() + " has no tensor, expected one as its value");
  addConstant(node.output(0), *tensor);
}

void GraphReader::readShapeNode(Node& node) {
  Value value = valueNamed(node.input(0), node.name());
  if (!value.is_state) requireVector(value.shape, node.name() + ": " + quoted(node.input(0)));
  const Shape shape = viewAfter(node, value.shape, opset_).shape;
  requireVector(shape, "the result of " + node.name());
  if (elementCount(shape, node.name()) != elementCount(value.shape, node.name())) {
    throw ModelFileError(node.name() + " takes " + shapeText(shape) + " of " + shapeText(value.shape) +
                         ", expected all of it");
  }
  value.shape = shape;
  define(node.output(0), value);
}

void GraphReader::readSlice(Node& node) {
  Value value = valueNamed(node.input(0), node.name());
  const View part = viewAfter(node, value.shape, opset_);
  const bool is_one_layer = isStackOfStates(value.shape) && !value.graph_input.empty() && part.shape[0] == 1 &&
                            part.shape[2] == value.shape[2];
  if (is_one_layer) {
    value.graph_input += "[" + std::to_string(part.first / part.shape[2]) + "]";
  } else if (part.shape != value.shape) {
    throw ModelFileError(node.name() + " takes " + shapeText(part.shape) + " of " + shapeText(value.shape) +
                         ", expected all of it, or the state of one layer");
  }
  value.shape = part.shape;
  define(node.output(0), value);
}

void GraphReader::readConcat(Node& node) {
  node.integer("axis", 0);
  if (valueNamed(node.input(0), node.name()).graph_input.empty()) {
    joinStates(node);
  } else {
    joinInputs(node);
  }
}

/// The network's input in several parts, one behind the other.
void GraphReader::joinInputs(Node& node) {
  std::vector<Shape> shapes;
  for (int index = 0; !node.input(index).empty(); ++index) {
    const Value& value = valueNamed(node.input(index), node.name());
    if (value.graph_input.empty()) {
      throw ModelFileError(node.name() + " joins " + quoted(node.input(index)) +
                           " to a graph input, expected another graph input");
    }
    takeGraphInput(node, value);
    shapes.push_back(value.shape);
  }
  const Shape joined = shapeAfterConcat(node, shapes);
  requireVector(joined, "the result of " + node.name());
  define(node.output(0), {joined, 0, false, ""});
}

/// States for the graph's outputs: nothing is computed from them.
void GraphReader::joinStates(Node& node) {
  for (int index = 0; !node.input(index).empty(); ++index) valueNamed(node.input(index), node.name());
  define(node.output(0), {{1}, stage_, true, ""});
}

void GraphReader::readLstm(Node& node) {
  const Shape shape = takeData(node, 3);
  LstmLayer layer = lstmLayer(node, shape.back());
  const std::int64_t cells = layer.recurrent.cols();
  takeInitialState(node, 5, cells);
  takeInitialState(node, 6, cells);
  addLayer(node, std::move(layer));
  defineStates(node, cells);
  define(node.output(2), {{1, 1, cells}, stage_, true, ""});
}

void GraphReader::readRnn(Node& node) {
  const Shape shape = takeData(node, 3);
  RecurrentLayer layer = recurrentLayer(node, shape.back());
  const std::int64_t units = layer.recurrent.cols();
  takeInitialState(node, 5, units);
  addLayer(node, std::move(layer));
  defineStates(node, units);
}

void GraphReader::readGemm(Node& node) {
  const Shape shape = takeData(node, 2);
  addDense(node, shape, denseLayer(node, shape.back()));
}

/// A layer without biases; an Add that follows brings them.
void GraphReader::readMatMul(Node& node) {
  const Shape shape = takeData(node, 0);
  if (shape.empty() || elementCount(shape, node.name()) != shape.back()) {
    throw ModelFileError(node.name() + " takes the shape " + shapeText(shape) +
                         ", expected all values along the last axis");
  }
  addDense(node, shape, productLayer(node, shape.back()));
  last_is_matmul_ = true;
}

void GraphReader::addDense(const Node& node, const Shape& shape, DenseLayer layer) {
  Shape result = shape;
  result.back() = layer.weights.rows();
  addLayer(node, std::move(layer));
  last_is_dense_ = true;
  define(node.output(0), {result, stage_, false, ""});
}

void GraphReader::readAdd(Node& node) {
  const int data = constants_.count(node.input(0)) > 0 ? 1 : 0;
  const Value value = valueNamed(node.input(data), node.name());
  if (!last_is_matmul_ || value.stage != stage_ || value.is_state) {
    throw ModelFileError(node.name() + " does not follow a MatMul, expected it there only");
  }
  auto& layer = std::get<DenseLayer>(layers_.back());
  const std::int64_t outputs = layer.weights.rows();
  if (outputs > 1 && value.shape.back() != outputs) {
    throw ModelFileError(node.name() + " adds biases to the shape " + shapeText(value.shape) + ", expected " +
                         std::to_string(outputs) + " values along the last axis");
  }
  layer.bias = biases(node, 1 - data, outputs);
  last_is_matmul_ = false;
  ++stage_;
  define(node.output(0), {value.shape, stage_, false, ""});
}

void GraphReader::readActivation(Node& node) {
  static const std::map<std::string, Activation> kActivations = {
      {"Relu", Activation::kRelu}, {"Sigmoid", Activation::kSigmoid}, {"Tanh", Activation::kTanh}};
  const Shape shape = takeData(node, 0);
  if (!last_is_dense_) throw ModelFileError(node.name() + " does not follow a Gemm or MatMul, expected it there only");
  std::get<DenseLayer>(layers_.back()).activation = kActivations.at(node.operatorName());
  last_is_dense_ = false;
  last_is_matmul_ = false;
  ++stage_;
  define(node.output(0), {shape, stage_, false, ""});
}

void GraphReader::readSoftmax(Node& node) {
  const Shape shape = takeData(node, 0);
  requireSoftmaxOverAll(node, shape, opset_);
  addLayer(node, SoftmaxLayer{});
  define(node.output(0), {shape, stage_, false, ""});
}

Shape GraphReader::takeData(const Node& node, std::size_t rank) {
  const Value& value = valueNamed(node.input(0), node.name());
  if (value.stage != stage_ || value.is_state) {
    throw ModelFileError(node.name() + " takes " + quoted(node.input(0)) +
                         ", expected the output of the layer before it: the network must be one chain of layers");
  }
  if (rank != 0 && (value.shape.size() != rank || elementCount(value.shape, node.name()) != value.shape.back())) {
    throw ModelFileError(node.name() + " takes the shape " + shapeText(value.shape) + ", expected " +
                         std::to_string(rank) + " axes, all values along the last");
  }
  if (!value.graph_input.empty()) takeGraphInput(node, value);
  return value.shape;
}

void GraphReader::takeInitialState(const Node& node, int index, std::int64_t units) {
  const std::string name = node.input(index);
  if (name.empty()) return;
  if (constants_.count(name) > 0) {
    const std::vector<float> stored = floatValues(node.requiredConstant(index, "initial state"));
    if (std::any_of(stored.begin(), stored.end(), [](float value) { return value != 0.0f; })) {
      throw ModelFileError(node.name() + " starts from the stored state " + quoted(name) +
                           ", which is not zero; expected zeros or a graph input");
    }
    return;
  }
  const Value& value = valueNamed(name, node.name());
  if (value.graph_input.empty()) {
    throw ModelFileError(node.name() + " starts from the computed state " + quoted(name) +
                         ", expected zeros or a graph input");
  }
  if (elementCount(value.shape, quoted(name)) != units) {
    throw ModelFileError(node.name() + " starts from the state " + quoted(name) + " of the shape " +
                         shapeText(value.shape) + ", expected " + std::to_string(units) + " values");
  }
  takeGraphInput(node, value);
}

void GraphReader::takeGraphInput(const Node& node, const Value& value) {
  if (!taken_graph_inputs_.insert(value.graph_input).second) {
    throw ModelFileError(node.name() + " takes the graph input " + quoted(value.graph_input) +
                         ", which is used elsewhere already; expected one use of each");
  }
}

void GraphReader::addLayer(const Node& node, Layer layer) {
  layers_.push_back(std::move(layer));
  last_is_dense_ = false;
  last_is_matmul_ = false;
  ++stage_;
  // Many nodes may share one stored tensor, so the size of the file is no limit to that of the network.
  if (layers_.size() > kMaximumLayers || countWeights(layers_) > kMaximumWeights) {
    throw ModelFileError(node.name() + " makes the network larger than " + std::to_string(kMaximumLayers) +
                         " layers or " + std::to_string(kMaximumWeights) + " weights");
  }
}

void GraphReader::defineStates(const Node& node, std::int64_t units) {
  // All steps and the last step are the same for a sequence of one.
  define(node.output(0), {{1, 1, 1, units}, stage_, false, ""});
  define(node.output(1), {{1, 1, units}, stage_, false, ""});
}

void GraphReader::requireOutputs() const {
  if (layers_.empty()) throw ModelFileError("the graph has no layers, expected at least one");
  bool has_preferences = false;
  for (const auto& output : graph_.output()) {
    const Value& value = valueNamed(output.name(), "the graph's output");
    has_preferences = has_preferences || (value.stage == stage_ && !value.is_state);
  }
  if (!has_preferences)
    throw ModelFileError("the last layer's output is not an output of the graph, expected it there");
}

}  // namespace lstm_planner::onnx
