#include "network/onnx_writer.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "network/onnx_names.hpp"
#include "network/onnx_tensor.hpp"

namespace lstm_planner::onnx {
namespace {

using Eigen::Index;
using Eigen::MatrixXf;
using Eigen::VectorXf;
using onnx_subset::GraphProto;
using onnx_subset::NodeProto;
using onnx_subset::TensorProto;
using onnx_subset::ValueInfoProto;
using Names = std::vector<std::string>;

constexpr char kSequenceAxes[] = "sequence_axes";
constexpr std::size_t kDenseRank = 2;      ///< [batch, values]
constexpr std::size_t kRecurrentRank = 3;  ///< [sequence, batch, values]

void describe(ValueInfoProto& info, const std::string& name, const Shape& shape) {
  info.set_name(name);
  auto& type = *info.mutable_type()->mutable_tensor_type();
  type.set_elem_type(kFloat);
  for (const std::int64_t extent : shape) type.mutable_shape()->add_dim()->set_dim_value(extent);
}

void setInteger(NodeProto& node, const std::string& name, std::int64_t value) {
  auto& attribute = *node.add_attribute();
  attribute.set_name(name);
  attribute.set_type(kAttributeInt);
  attribute.set_i(value);
}

/// Appends the nodes of one layer after the other.
class GraphWriter {
 public:
  explicit GraphWriter(Index inputs) : data_("observation") {
    graph_.set_name("lstm_planner");
    describe(*graph_.add_input(), data_, {1, inputs});
    // The place of the preferences among the outputs is the first one; their name and width follow in finish().
    graph_.add_output();
  }

  void add(const LstmLayer& layer) {
    const Index cells = layer.recurrent.cols();
    NodeProto& node = addRecurrent("LSTM", layer.input, layer.recurrent, layer.bias);
    addState(node, "_hidden", cells);
    addState(node, "_cell", cells);
    if (layer.candidate == Activation::kSigmoid) {
      auto& activations = *node.add_attribute();
      activations.set_name("activations");
      activations.set_type(kAttributeStrings);
      for (const char* gate : {"Sigmoid", "Sigmoid", "Tanh"}) activations.add_strings(gate);
    }
  }

  void add(const RecurrentLayer& layer) {
    NodeProto& node = addRecurrent("RNN", layer.input, layer.recurrent, layer.bias);
    addState(node, "_hidden", layer.recurrent.cols());
  }

  void add(const DenseLayer& layer) {
    startLayer(kDenseRank);
    addWeights("_weights", {layer.weights.rows(), layer.weights.cols()}, layer.weights);
    addWeights("_biases", {layer.bias.size()}, layer.bias);
    setInteger(addNode("Gemm", {data_, prefix_ + "_weights", prefix_ + "_biases"}, prefix_), "transB", 1);
    switch (layer.activation) {
      case Activation::kIdentity:
        return;
      case Activation::kRelu:
        addNode("Relu", {data_}, prefix_ + "_relu");
        return;
      case Activation::kTanh:
        addNode("Tanh", {data_}, prefix_ + "_tanh");
        return;
      case Activation::kSigmoid:
        addNode("Sigmoid", {data_}, prefix_ + "_sigmoid");
        return;
    }
  }

  void add(const SoftmaxLayer&) {
    startLayer(kDenseRank);
    setInteger(addNode("Softmax", {data_}, prefix_), "axis", -1);
  }

  GraphProto finish(Index outputs) {
    setRank(kDenseRank);
    graph_.mutable_node(graph_.node_size() - 1)->set_output(0, "preferences");
    describe(*graph_.mutable_output(0), "preferences", {1, outputs});
    return std::move(graph_);
  }

 private:
  void startLayer(std::size_t rank) {
    setRank(rank);
    ++layer_number_;
    prefix_ = "layer_" + std::to_string(layer_number_);
  }

  void setRank(std::size_t rank) {
    if (rank == rank_) return;
    rank_ = rank;
    if (!has_sequence_axes_) {
      TensorProto& axes = *graph_.add_initializer();
      axes.set_name(kSequenceAxes);
      axes.set_data_type(kInt64);
      axes.add_dims(1);
      axes.add_int64_data(0);
      has_sequence_axes_ = true;
    }
    const bool adds_sequence = rank == kRecurrentRank;
    addNode(adds_sequence ? "Unsqueeze" : "Squeeze", {data_, kSequenceAxes},
            data_ + (adds_sequence ? "_sequence" : "_step"));
  }

  NodeProto& addNode(const char* operator_name, const Names& inputs, const std::string& output) {
    NodeProto& node = *graph_.add_node();
    node.set_op_type(operator_name);
    node.set_name(output);
    for (const std::string& input : inputs) node.add_input(input);
    node.add_output(output);
    data_ = output;
    return node;
  }

  void addWeights(const std::string& suffix, const Shape& shape, const MatrixXf& values) {
    TensorProto& tensor = *graph_.add_initializer();
    tensor.set_name(prefix_ + suffix);
    tensor.set_data_type(kFloat);
    for (const std::int64_t extent : shape) tensor.add_dims(extent);
    const MatrixXf columns = values.transpose();  // whose column-major data are the row-major data of `values`
    tensor.set_raw_data(columns.data(), static_cast<std::size_t>(columns.size()) * sizeof(float));
  }

  NodeProto& addRecurrent(const char* operator_name, const MatrixXf& input, const MatrixXf& recurrent,
                          const VectorXf& bias) {
    startLayer(kRecurrentRank);
    addWeights("_input_weights", {1, input.rows(), input.cols()}, input);
    addWeights("_recurrent_weights", {1, recurrent.rows(), recurrent.cols()}, recurrent);
    VectorXf both_biases = VectorXf::Zero(2 * bias.size());
    both_biases.head(bias.size()) = bias;
    addWeights("_biases", {1, both_biases.size()}, both_biases);

    const std::string no_sequence_lengths;
    const Names inputs = {data_, prefix_ + "_input_weights", prefix_ + "_recurrent_weights", prefix_ + "_biases",
                          no_sequence_lengths};
    // The output for all steps is left out; that of the last one comes with the states.
    NodeProto& node = addNode(operator_name, inputs, "");
    node.set_name(prefix_);
    data_ = prefix_ + "_hidden_next";
    setInteger(node, "hidden_size", recurrent.cols());
    return node;
  }

  void addState(NodeProto& node, const std::string& suffix, Index units) {
    const std::string name = prefix_ + suffix;
    node.add_input(name);
    node.add_output(name + "_next");
    describe(*graph_.add_input(), name, {1, 1, units});
    describe(*graph_.add_output(), name + "_next", {1, 1, units});
  }

  GraphProto graph_;
  std::string data_;    ///< name of the newest data in the chain
  std::string prefix_;  ///< of all names of the current layer
  std::size_t rank_ = kDenseRank;
  int layer_number_ = 0;
  bool has_sequence_axes_ = false;
};

}  // namespace

GraphProto writeGraph(const LayerStack& layers) {
  GraphWriter writer(inputSize(layers));
  for (const Layer& layer : layers) {
    std::visit([&](const auto& typed) { writer.add(typed); }, layer);
  }
  return writer.finish(outputSize(layers));
}

}  // namespace lstm_planner::onnx
