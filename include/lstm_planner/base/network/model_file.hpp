#pragma once

#include <map>
#include <stdexcept>
#include <string>

#include "lstm_planner/base/network/layers.hpp"

namespace lstm_planner {

/// What a model file holds: the layers, and text metadata by key (the encoder's and the action set's constants, how the
/// model was trained, what it scored). network/ does not interpret the metadata.
struct Model {
  LayerStack layers;
  std::map<std::string, std::string> metadata;
};

/// A model file that cannot be used; what() is one sentence naming the file, the thing, its value and what was
/// expected.
class ModelFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads an ONNX file (operator sets 7 to 22) whose graph is one chain of the operators LSTM, RNN, Gemm, MatMul
/// with Add, Relu, Tanh, Sigmoid and Softmax, with the operators that exporters put between them (Concat, Constant,
/// Gather, Identity, Reshape, Slice, Squeeze, Transpose, Unsqueeze).
///
/// The graph stands for one step of one robot: batch and sequence are 1 or have no number. The input may be several
/// graph inputs, joined by a Concat. Initial states are graph inputs, zeros or left out, or the layers' parts of one
/// graph input; Network carries them in any case. An activation follows a Gemm, and an LSTM's activations
/// are Sigmoid, Tanh or Sigmoid, Tanh (gates, candidate, output).
///
/// Throws ModelFileError for a file that is missing, truncated or not ONNX, and for an unknown operator or attribute,
/// wrong shapes, weights that are not finite, and networks of more than 256 layers or 2^24 weights.
Model readModelFile(const std::string& path);

/// Writes an ONNX file (opset 14, one step, batch 1, hidden states as inputs and outputs of the graph) which replaces
/// an existing one only when it is complete. Throws ModelFileError when the layers are not valid or the file cannot be
/// written.
void writeModelFile(const std::string& path, const Model& model);

}  // namespace lstm_planner
