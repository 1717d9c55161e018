#include <algorithm>
#include <cstring>

#include "lstm_planner/network/network.hpp"
#include "unit/network/model_file_fixtures.hpp"
#include "unit/network/network_fixtures.hpp"

// Forms of the same network that other exporters write.

namespace lstm_planner::test_model_file_exporters {
namespace {

using onnx_subset::ModelProto;
using onnx_subset::NodeProto;
using onnx_subset::TensorProto;
using test::addAttribute;
using test::LayerMaker;
using test::nodeNamed;
using test::tensorNamed;

/// layer_1: LSTM 3 -> 2, layer_2: dense 2 -> 4, layer_3: softmax. The graph is observation, Unsqueeze, LSTM, Squeeze,
/// Gemm, Softmax.
class ModelFileExporters : public test::ModelFileTest {
 protected:
  void SetUp() override {
    ModelFileTest::SetUp();
    LayerMaker make(1);
    layers_ = {make.lstm(3, 2), make.dense(2, 4), SoftmaxLayer{}};
    file_ = written({layers_, {}});
  }

  void expectSameNetwork() {
    Network read_network(read(file_).layers);
    Network network(layers_);
    LayerMaker make(2);
    for (int step = 0; step < 20; ++step) {
      const Eigen::VectorXf input = make.input(3);
      ASSERT_TRUE(read_network.forward(input).isApprox(network.forward(input), 1e-6f));
    }
  }

  std::string squeezeName() { return "layer_1_hidden_next_step"; }
  std::string unsqueezeName() { return "observation_sequence"; }

  /// The nodes so added come before all others, in the order in which they are added.
  NodeProto& addNode(const std::string& type, const std::vector<std::string>& inputs, const std::string& output) {
    auto& nodes = *file_.mutable_graph()->mutable_node();
    NodeProto& node = *nodes.Add();
    node.set_op_type(type);
    for (const std::string& input : inputs) node.add_input(input);
    node.add_output(output);
    std::rotate(nodes.begin() + added_nodes_, nodes.end() - 1, nodes.end());
    return *nodes.Mutable(added_nodes_++);
  }

  /// A stored tensor under another name, for a node that makes the old one of it.
  TensorProto& stored(const std::string& name) {
    TensorProto& tensor = tensorNamed(file_, name);
    tensor.set_name("stored_" + name);
    return tensor;
  }

  void setIntegers(const std::string& name, const std::vector<int>& values) {
    TensorProto& tensor = *file_.mutable_graph()->add_initializer();
    tensor.set_name(name);
    tensor.set_data_type(7);
    tensor.add_dims(static_cast<int>(values.size()));
    for (const int value : values) tensor.add_int64_data(value);
  }

  LayerStack layers_;
  ModelProto file_;
  int added_nodes_ = 0;
};

void setShape(const std::vector<int>& shape, TensorProto* tensor) {
  tensor->clear_dims();
  for (const int extent : shape) tensor->add_dims(extent);
}

void setValues(const Eigen::MatrixXf& values, TensorProto* tensor) {
  tensor->set_raw_data(values.data(), static_cast<std::size_t>(values.size()) * sizeof(float));
}

TEST_F(ModelFileExporters, WeightsAsTypedFloats) {
  for (TensorProto& tensor : *file_.mutable_graph()->mutable_initializer()) {
    if (tensor.data_type() != 1) continue;
    const std::string raw = tensor.raw_data();
    for (std::size_t byte = 0; byte < raw.size(); byte += sizeof(float)) {
      float value = 0.0f;
      std::memcpy(&value, raw.data() + byte, sizeof(float));
      tensor.add_float_data(value);
    }
    tensor.clear_raw_data();
  }
  expectSameNetwork();
}

TEST_F(ModelFileExporters, BiasesOnTheRecurrentSide) {
  std::string& raw = *tensorNamed(file_, "layer_1_biases").mutable_raw_data();
  raw = raw.substr(raw.size() / 2) + raw.substr(0, raw.size() / 2);
  expectSameNetwork();
}

TEST_F(ModelFileExporters, BiasesOnBothSidesAreAdded) {
  std::string& raw = *tensorNamed(file_, "layer_1_biases").mutable_raw_data();
  raw = raw.substr(0, raw.size() / 2) + raw.substr(0, raw.size() / 2);
  std::get<LstmLayer>(layers_[0]).bias *= 2.0f;
  expectSameNetwork();
}

TEST_F(ModelFileExporters, NoBiases) {
  nodeNamed(file_, "layer_1").set_input(3, "");
  nodeNamed(file_, "layer_2").mutable_input()->RemoveLast();
  std::get<LstmLayer>(layers_[0]).bias.setZero();
  std::get<DenseLayer>(layers_[1]).bias.setZero();
  expectSameNetwork();
}

TEST_F(ModelFileExporters, NoHiddenSize) {
  nodeNamed(file_, "layer_1").clear_attribute();
  expectSameNetwork();
}

TEST_F(ModelFileExporters, GemmWithWeightsAsInputsTimesOutputs) {
  TensorProto& tensor = tensorNamed(file_, "layer_2_weights");
  // The column-major data of a matrix are the row-major data of its transpose.
  const Eigen::MatrixXf& weights = std::get<DenseLayer>(layers_[1]).weights;
  tensor.set_raw_data(weights.data(), static_cast<std::size_t>(weights.size()) * sizeof(float));
  tensor.set_dims(0, 2);
  tensor.set_dims(1, 4);
  NodeProto& gemm = nodeNamed(file_, "layer_2");
  gemm.clear_attribute();
  addAttribute(gemm, "alpha").set_f(1.0f);
  addAttribute(gemm, "beta").set_f(1.0f);
  expectSameNetwork();
}

TEST_F(ModelFileExporters, StatesThatAreLeftOutOrStoredZeros) {
  NodeProto& lstm = nodeNamed(file_, "layer_1");
  TensorProto& zeros = *file_.mutable_graph()->add_initializer();
  zeros.set_name("zeros");
  zeros.set_data_type(1);
  for (const int extent : {1, 1, 2}) zeros.add_dims(extent);
  zeros.add_float_data(0.0f);
  zeros.add_float_data(0.0f);
  lstm.set_input(5, "");
  lstm.set_input(6, "zeros");
  file_.mutable_graph()->mutable_input()->DeleteSubrange(1, 2);
  file_.mutable_graph()->mutable_output()->DeleteSubrange(1, 2);
  expectSameNetwork();
}

TEST_F(ModelFileExporters, OutputOfAllStepsInsteadOfTheLast) {
  nodeNamed(file_, "layer_1").set_output(0, "all_steps");
  NodeProto& squeeze = nodeNamed(file_, squeezeName());
  squeeze.set_input(0, "all_steps");
  squeeze.set_input(1, "first_two_axes");
  setIntegers("first_two_axes", {0, -3});
  expectSameNetwork();
}

TEST_F(ModelFileExporters, ReshapesTransposesAndIdentities) {
  NodeProto& unsqueeze = nodeNamed(file_, unsqueezeName());
  unsqueeze.set_op_type("Reshape");
  unsqueeze.set_input(1, "sequence_shape");
  setIntegers("sequence_shape", {-1, 1, 3});
  NodeProto& squeeze = nodeNamed(file_, squeezeName());
  squeeze.set_op_type("Reshape");
  squeeze.set_input(1, "step_shape");
  setIntegers("step_shape", {0, -1});

  NodeProto transpose;
  transpose.set_op_type("Transpose");
  transpose.add_input(unsqueezeName());
  transpose.add_output("transposed");
  auto& order = addAttribute(transpose, "perm");
  for (const int axis : {1, 0, 2}) order.add_ints(axis);
  NodeProto identity;
  identity.set_op_type("Identity");
  identity.add_input("transposed");
  identity.add_output("copied");

  const auto nodes = file_.graph().node();
  file_.mutable_graph()->clear_node();
  *file_.mutable_graph()->add_node() = nodes.Get(0);
  *file_.mutable_graph()->add_node() = transpose;
  *file_.mutable_graph()->add_node() = identity;
  for (int index = 1; index < nodes.size(); ++index) *file_.mutable_graph()->add_node() = nodes.Get(index);
  nodeNamed(file_, "layer_1").set_input(0, "copied");
  expectSameNetwork();
}

TEST_F(ModelFileExporters, FlattensAtAnyPlaceThatKeepsTheValuesInOneRow) {
  NodeProto& flatten = nodeNamed(file_, squeezeName());
  flatten.set_op_type("Flatten");
  flatten.mutable_input()->RemoveLast();
  expectSameNetwork();  // before axis 1 without the attribute
  auto& axis = addAttribute(flatten, "axis");
  for (const int place : {0, 1, 2, -1, -3}) {  // of 1 x 1 x 2
    axis.set_i(place);
    SCOPED_TRACE(place);
    expectSameNetwork();
  }
}

TEST_F(ModelFileExporters, FlattensIntoAColumnOrAtNoPlaceAreRefused) {
  NodeProto& flatten = nodeNamed(file_, squeezeName());
  flatten.set_op_type("Flatten");
  flatten.mutable_input()->RemoveLast();
  auto& axis = addAttribute(flatten, "axis");
  axis.set_i(3);
  EXPECT_REFUSED(refusal(file_), "takes the shape [2, 1], expected 2 axes, all values along the last");
  axis.set_i(4);
  EXPECT_REFUSED(refusal(file_), "names the axis 4, expected one of 3 axes");
  axis.set_i(-4);
  EXPECT_REFUSED(refusal(file_), "names the axis -4, expected one of 3 axes");
}

TEST_F(ModelFileExporters, ConstantNodes) {
  const TensorProto weights = tensorNamed(file_, "layer_2_weights");
  tensorNamed(file_, "layer_2_weights").set_name("unused");
  const auto nodes = file_.graph().node();
  file_.mutable_graph()->clear_node();
  NodeProto& constant = *file_.mutable_graph()->add_node();
  constant.set_op_type("Constant");
  constant.add_output("layer_2_weights");
  *addAttribute(constant, "value").mutable_t() = weights;
  for (const NodeProto& node : nodes) *file_.mutable_graph()->add_node() = node;
  expectSameNetwork();
}

TEST_F(ModelFileExporters, GatesInAnotherOrderThatNodesPutInto) {
  for (const std::string name : {"layer_1_input_weights", "layer_1_recurrent_weights"}) {
    TensorProto& tensor = stored(name);
    const int columns = static_cast<int>(tensor.dims(2));
    setShape({8, columns}, &tensor);
    const std::string raw = tensor.raw_data();
    const std::size_t gate = raw.size() / 4;
    // ONNX has i, o, f, c; PyTorch has i, f, c, o.
    tensor.set_raw_data(raw.substr(0, gate) + raw.substr(2 * gate) + raw.substr(gate, gate));
    std::vector<std::string> parts;
    for (const int place : {0, 6, 2, 4}) {
      parts.push_back(name + "_" + std::to_string(place));
      setIntegers(parts.back() + "_start", {place});
      setIntegers(parts.back() + "_end", {place + 2});
      addNode("Slice", {"stored_" + name, parts.back() + "_start", parts.back() + "_end"}, parts.back());
    }
    addAttribute(addNode("Concat", parts, name + "_joined"), "axis").set_i(0);
    setIntegers(name + "_axis", {0});
    addNode("Unsqueeze", {name + "_joined", name + "_axis"}, name);
  }
  expectSameNetwork();
}

TEST_F(ModelFileExporters, ColumnsOfWeightsThatNodesCutAndJoin) {
  TensorProto& tensor = stored("layer_1_input_weights");  // 1 x 8 x 3
  for (const int column : {0, 1, 2}) {
    setIntegers("column_" + std::to_string(column), {column});
    addAttribute(
        addNode("Gather", {tensor.name(), "column_" + std::to_string(column)}, "part_" + std::to_string(column)),
        "axis")
        .set_i(2);
  }
  addAttribute(addNode("Concat", {"part_0", "part_1", "part_2"}, "layer_1_input_weights"), "axis").set_i(-1);
  expectSameNetwork();
}

TEST_F(ModelFileExporters, TransposedWeights) {
  TensorProto& tensor = stored("layer_2_weights");  // 4 x 2
  setShape({2, 4}, &tensor);
  setValues(std::get<DenseLayer>(layers_[1]).weights, &tensor);
  addNode("Transpose", {tensor.name()}, "layer_2_weights");
  expectSameNetwork();
}

TEST_F(ModelFileExporters, WeightsInAnyShapeThatANodeTurnsIntoTheirOwn) {
  setIntegers("zero", {0});
  setIntegers("one", {1});
  setIntegers("shape", {4, -1});
  setIntegers("shape_for_expand", {1, 2});
  stored("layer_2_weights");
  const ModelProto without_node = file_;
  const auto expectSame = [&](const std::string& type, const std::vector<int>& shape, const std::string& operand) {
    SCOPED_TRACE(type);
    file_ = without_node;
    added_nodes_ = 0;
    setShape(shape, &tensorNamed(file_, "stored_layer_2_weights"));
    std::vector<std::string> inputs = {"stored_layer_2_weights"};
    if (!operand.empty()) inputs.push_back(operand);
    addNode(type, inputs, "layer_2_weights");
    expectSameNetwork();
  };
  expectSame("Identity", {4, 2}, "");
  expectSame("Reshape", {8}, "shape");
  expectSame("Flatten", {4, 1, 2}, "");
  expectSame("Squeeze", {4, 1, 2}, "one");
  expectSame("Expand", {4, 2}, "shape_for_expand");
}

TEST_F(ModelFileExporters, AColumnOfWeightsThatIsExpanded) {
  Eigen::MatrixXf& weights = std::get<DenseLayer>(layers_[1]).weights;  // 4 x 2
  weights.col(1) = weights.col(0);
  TensorProto& tensor = stored("layer_2_weights");
  setShape({4, 1}, &tensor);
  setValues(weights.col(0), &tensor);
  setIntegers("shape", {4, 2});
  addNode("Expand", {tensor.name(), "shape"}, "layer_2_weights");
  expectSameNetwork();
}

TEST_F(ModelFileExporters, NodesThatMakeWhatNoNetworkHasOfWeightsAreRefused) {
  stored("layer_2_weights");
  setIntegers("huge", {1 << 13, 4, 2});
  setIntegers("axes", {0, 1, 2, 3, 4, 5, 6});
  setIntegers("far", {4});
  const ModelProto without_node = file_;
  const auto refusalOfNode = [&](const std::string& type, const std::vector<std::string>& inputs) {
    file_ = without_node;
    added_nodes_ = 0;
    addNode(type, inputs, "layer_2_weights");
    return refusal(file_);
  };
  EXPECT_REFUSED(refusalOfNode("Unsqueeze", {"stored_layer_2_weights", "axes"}), "has 9 axes, expected at most 8");
  EXPECT_REFUSED(refusalOfNode("Gather", {"stored_layer_2_weights", "far"}), "picks from the axis 0 of [4, 2]");
  EXPECT_REFUSED(refusalOfNode("Expand", {"stored_layer_2_weights", "far"}), "which do not fit together");
  EXPECT_REFUSED(refusalOfNode("Concat", {"stored_layer_2_weights", "axes"}), "joins");
  EXPECT_REFUSED(refusalOfNode("Cast", {"stored_layer_2_weights"}), "casts");
  file_ = without_node;
  added_nodes_ = 0;
  addNode("Expand", {"stored_layer_2_weights", "huge"}, "many");
  std::vector<std::string> all(40, "many");
  addAttribute(addNode("Concat", all, "more"), "axis").set_i(0);
  EXPECT_REFUSED(refusal(file_), "values of constants");
}

TEST_F(ModelFileExporters, ReshapesThatAllowZerosWhereNoExtentIsZero) {
  NodeProto& squeeze = nodeNamed(file_, squeezeName());
  squeeze.set_op_type("Reshape");
  squeeze.set_input(1, "step_shape");
  addAttribute(squeeze, "allowzero").set_i(1);
  setIntegers("step_shape", {1, 2});
  expectSameNetwork();
  tensorNamed(file_, "step_shape").set_int64_data(0, 0);
  EXPECT_REFUSED(refusal(file_), "makes the shape [0, 2] of 2 values");
}

TEST_F(ModelFileExporters, OperatorSetsWithAxesAsAttributes) {
  file_.mutable_opset_import(0)->set_version(9);
  for (const std::string& name : {squeezeName(), unsqueezeName()}) {
    NodeProto& node = nodeNamed(file_, name);
    node.mutable_input()->RemoveLast();
    addAttribute(node, "axes").add_ints(0);
  }
  nodeNamed(file_, "layer_3").mutable_attribute(0)->set_i(1);
  expectSameNetwork();
}

TEST_F(ModelFileExporters, BatchWithoutANumberAndWeightsAmongTheInputs) {
  auto& shape = *file_.mutable_graph()->mutable_input(0)->mutable_type()->mutable_tensor_type()->mutable_shape();
  shape.mutable_dim(0)->clear_dim_value();
  shape.mutable_dim(0)->set_dim_param("batch");
  for (const TensorProto& tensor : file_.graph().initializer())
    file_.mutable_graph()->add_input()->set_name(tensor.name());
  expectSameNetwork();
}

}  // namespace
}  // namespace lstm_planner::test_model_file_exporters
