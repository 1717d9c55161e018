#pragma once

#include <map>
#include <stdexcept>
#include <string>

#include "lstm_planner/network/layers.hpp"

namespace lstm_planner {

/// The content of a model file: the layers, and metadata as text by key (constants of the encoder and the action set,
/// how the model was trained, its scores). The code in network/ does not interpret the metadata.
struct Model {
  LayerStack layers;
  std::map<std::string, std::string> metadata;
};

/// A model file that cannot be used. what() is one sentence naming the file, the cause, the value and what was
/// expected.
class ModelFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads an ONNX file (operator sets 7 to 22). The graph must be a single chain of the operators LSTM, RNN, Gemm,
/// MatMul with Add, Relu, Tanh, Sigmoid and Softmax, and of the operators that exporters put between them (Cast,
/// Concat, Constant, ConstantOfShape, Expand, Flatten, Gather, Identity, Reshape, Shape, Slice, Squeeze, Transpose,
/// Unsqueeze).
///
/// The graph computes one step of one robot: batch and sequence are 1 or have no number. The input may be several graph
/// inputs that are joined by a Concat. Initial states may be graph inputs, zeros, missing, or parts of one graph input;
/// Network carries the states in every case. An activation follows a Gemm. The activations of an LSTM (gates,
/// candidate, output) are Sigmoid, Tanh, Tanh or Sigmoid, Sigmoid, Tanh.
///
/// Throws ModelFileError for a file that is missing, truncated or not ONNX, for an unknown operator or attribute, for
/// wrong shapes, weights that are not finite, and networks with more than 256 layers or 2^24 weights. All unknown
/// operators and all graph inputs of a wrong shape are named together; else the first fault.
Model readModelFile(const std::string& path);

/// The metadata of an ONNX file, whatever its graph is. Throws ModelFileError for a file that is missing, truncated or
/// not ONNX, and for a key that is there twice.
std::map<std::string, std::string> readModelMetadata(const std::string& path);

/// Writes an ONNX file (opset 14, one step, batch 1, hidden states as inputs and outputs of the graph). An existing
/// file is replaced only when the new one is complete. Throws ModelFileError if the layers are not valid or the file
/// cannot be written.
void writeModelFile(const std::string& path, const Model& model);

}  // namespace lstm_planner
