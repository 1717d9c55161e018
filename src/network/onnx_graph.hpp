#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>

#include "lstm_planner/network/layers.hpp"
#include "network/onnx_folding.hpp"
#include "network/onnx_node.hpp"

namespace lstm_planner::onnx {

bool isStandardDomain(const std::string& domain);

/// Reads a graph that is one chain of layers, from the observation to the preferences.
///
/// Follows every value with its shape for one step of one robot: extents without a number (batch, sequence) are 1.
class GraphReader {
 public:
  /// `graph` must outlive this object.
  GraphReader(const onnx_subset::GraphProto& graph, std::int64_t opset) : graph_(graph), opset_(opset) {}

  /// Call once. Throws ModelFileError.
  LayerStack read();

 private:
  /// What is known of a value on its way through the graph.
  struct Value {
    Shape shape;
    int stage = 0;            ///< number of computing nodes behind it
    bool is_state = false;    ///< an LSTM's cell state, or states of several layers: no node may take it as its data
    std::string graph_input;  ///< the graph input that it is, in whatever shape; else empty
  };

  using ReadNode = void (GraphReader::*)(Node&);
  static const std::map<std::string, ReadNode>& operators();
  std::string unknownOperators() const;

  void addConstant(const std::string& name, const onnx_subset::TensorProto& tensor);
  void addGraphInput(const onnx_subset::ValueInfoProto& input);
  void define(const std::string& name, const Value& value);
  const Value& valueNamed(const std::string& name, const std::string& user) const;

  void readNode(const onnx_subset::NodeProto& node);
  void readConstant(Node& node);
  void readShapeNode(Node& node);
  void readShape(Node& node);
  bool isConstant(const onnx_subset::NodeProto& node) const;
  void fold(Node& node);
  void readSlice(Node& node);
  void readConcat(Node& node);
  void readLstm(Node& node);
  void readRnn(Node& node);
  void readGemm(Node& node);
  void readMatMul(Node& node);
  void readAdd(Node& node);
  void readActivation(Node& node);
  void readSoftmax(Node& node);

  /// Shape of the data that a computing node takes, which must be the newest there are.
  Shape takeData(const Node& node, std::size_t rank);
  void takeInitialState(const Node& node, int index, std::int64_t units);
  void addDense(const Node& node, const Shape& shape, DenseLayer layer);
  void joinInputs(Node& node);
  void joinStates(Node& node);
  void takeGraphInput(const Node& node, const Value& value);
  void addLayer(const Node& node, Layer layer);
  void defineStates(const Node& node, std::int64_t units);
  void requireOutputs() const;

  const onnx_subset::GraphProto& graph_;
  const std::int64_t opset_;
  Constants constants_;
  std::deque<onnx_subset::TensorProto> folded_;  ///< constants that nodes made of constants
  std::int64_t folding_room_ = kMostFoldedValues;
  std::map<std::string, Value> values_;
  std::set<std::string> taken_graph_inputs_;
  int stage_ = 0;
  bool last_is_dense_ = false;   ///< an activation may follow
  bool last_is_matmul_ = false;  ///< a bias may be added
  LayerStack layers_;
};

}  // namespace lstm_planner::onnx
