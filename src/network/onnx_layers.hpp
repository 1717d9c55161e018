#pragma once

#include "lstm_planner/network/layers.hpp"
#include "network/onnx_node.hpp"

namespace lstm_planner::onnx {

/// The layer that a node of the operator LSTM, RNN or Gemm stands for, on an input of that many values. Throw
/// ModelFileError when its tensors do not fit together or an attribute asks for what the layer cannot do.
LstmLayer lstmLayer(Node& node, std::int64_t inputs);
RecurrentLayer recurrentLayer(Node& node, std::int64_t inputs);
DenseLayer denseLayer(Node& node, std::int64_t inputs);
/// Of a MatMul, which has no biases, or of a Gemm before them. `transposed`: an output's weights lie in a row.
DenseLayer productLayer(const Node& node, std::int64_t inputs, bool transposed = false);

/// The constant at an input of an Add, which may have any number of axes.
Eigen::VectorXf biases(const Node& node, int index, std::int64_t outputs);

}  // namespace lstm_planner::onnx
