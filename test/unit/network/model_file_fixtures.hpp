#pragma once

#include <stdexcept>
#include <string>

#include "lstm_planner/network/model_file.hpp"
#include "onnx_subset.pb.h"
#include "support/folder_test.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test {

/// A model file in a folder of its own for each test.
class ModelFileTest : public FolderTest {
 protected:
  void writeBytes(const std::string& bytes) const { scratch_.write("model.onnx", bytes); }

  std::string readBytes() const { return scratch_.read("model.onnx"); }

  /// The file as ONNX, to be changed into what other exporters write and what is not allowed.
  onnx_subset::ModelProto written(const Model& model) const {
    writeModelFile(path_, model);
    onnx_subset::ModelProto file;
    EXPECT_TRUE(file.ParseFromString(readBytes()));
    return file;
  }

  Model read(const onnx_subset::ModelProto& file) const {
    writeBytes(file.SerializeAsString());
    return readModelFile(path_);
  }

  /// Why a file is refused; empty when it is not.
  std::string refusal() const {
    return refusalOf<ModelFileError>([&] { readModelFile(path_); });
  }
  std::string refusal(const onnx_subset::ModelProto& file) const {
    writeBytes(file.SerializeAsString());
    return refusal();
  }

  const std::string path_ = in("model.onnx");
};

inline onnx_subset::TensorProto& tensorNamed(onnx_subset::ModelProto& file, const std::string& name) {
  for (auto& tensor : *file.mutable_graph()->mutable_initializer()) {
    if (tensor.name() == name) return tensor;
  }
  throw std::out_of_range("no tensor " + name);
}

inline onnx_subset::NodeProto& nodeNamed(onnx_subset::ModelProto& file, const std::string& name) {
  for (auto& node : *file.mutable_graph()->mutable_node()) {
    if (node.name() == name) return node;
  }
  throw std::out_of_range("no node " + name);
}

inline onnx_subset::AttributeProto& addAttribute(onnx_subset::NodeProto& node, const std::string& name) {
  auto& attribute = *node.add_attribute();
  attribute.set_name(name);
  return attribute;
}

}  // namespace lstm_planner::test

/// The sentence names the file and says `part`.
#define EXPECT_REFUSED(expression, part)                                                           \
  do {                                                                                             \
    const std::string reason = (expression);                                                       \
    EXPECT_TRUE(reason.find(path_) != std::string::npos && reason.find(part) != std::string::npos) \
        << "expected " << part << ", got: " << reason;                                             \
  } while (false)
