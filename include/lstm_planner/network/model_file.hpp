#pragma once

#include <map>
#include <stdexcept>
#include <string>

#include "lstm_planner/network/layers.hpp"

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

/// Reads an ONNX file made of the operators LSTM, RNN, Gemm, Relu, Tanh, Sigmoid, Softmax (and the shape operators that
/// exporters put between them: Squeeze, Unsqueeze, Reshape, Identity). Throws ModelFileError for a file that is
/// missing, truncated, not ONNX, has an unknown operator, wrong shapes or non-finite weights.
Model readModelFile(const std::string& path);

/// Writes an ONNX file (opset 14, one step, batch 1, hidden states as inputs and outputs of the graph) which replaces
/// an existing one only when it is complete. Throws ModelFileError when the layers are not valid or the file cannot be
/// written.
void writeModelFile(const std::string& path, const Model& model);

}  // namespace lstm_planner
