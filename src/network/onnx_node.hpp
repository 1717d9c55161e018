#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "network/onnx_tensor.hpp"

namespace lstm_planner::onnx {

/// Tensors stored in the file, by name.
using Constants = std::map<std::string, const onnx_subset::TensorProto*>;

/// One node of the graph with what is stored in the file for it.
///
/// Each getter of an attribute marks it as understood; finish() refuses those that are left, so that no attribute which
/// changes a result is passed over.
class Node {
 public:
  /// Both must outlive this object. Throws ModelFileError for an attribute that appears twice.
  Node(const onnx_subset::NodeProto& node, const Constants& constants);

  /// For messages: `node "layer_1" (LSTM)`.
  const std::string& name() const { return name_; }
  const std::string& operatorName() const { return node_.op_type(); }

  /// Name of an input or output; empty when it is left out.
  std::string input(int index) const;
  std::string output(int index) const;

  /// The stored tensor at an input; null when that is left out. Throws ModelFileError, naming `role`, when the tensor
  /// is computed or given at run time.
  const onnx_subset::TensorProto* constant(int index, const std::string& role) const;
  /// The same for an input that must be there.
  const onnx_subset::TensorProto& requiredConstant(int index, const std::string& role) const;
  /// Throws ModelFileError, naming `role`, when the node has this input.
  void refuseInput(int index, const std::string& role) const;

  std::int64_t integer(const std::string& name, std::int64_t absent);
  std::string text(const std::string& name, const std::string& absent);
  std::vector<std::int64_t> integers(const std::string& name);
  std::vector<std::string> texts(const std::string& name, const std::vector<std::string>& absent);
  const onnx_subset::TensorProto* tensor(const std::string& name);  ///< null when there is none

  /// Throw ModelFileError when the attribute is there and has another value.
  void requireInteger(const std::string& name, std::int64_t expected);
  void requireReal(const std::string& name, float expected);

  /// Throws ModelFileError naming an attribute that nobody asked for.
  void finish() const;

 private:
  const onnx_subset::AttributeProto* find(const std::string& name);

  const onnx_subset::NodeProto& node_;
  const Constants& constants_;
  std::string name_;
  std::set<std::string> understood_;
};

}  // namespace lstm_planner::onnx
