#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "lstm_planner/base/network/model_file.hpp"
#include "onnx_subset.pb.h"

namespace lstm_planner::test {

/// An empty folder for each test, removed after it.
class ModelFileTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "lstm_planner_model_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    path_ = (folder_ / "model.onnx").string();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void writeBytes(const std::string& bytes) const {
    // A new file stays in the cache; some file systems write one that is truncated to the disk at once.
    std::filesystem::remove(path_);
    std::ofstream(path_, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

  std::string readBytes() const {
    std::ifstream file(path_, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }

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
    try {
      readModelFile(path_);
    } catch (const ModelFileError& error) {
      return error.what();
    }
    return "";
  }
  std::string refusal(const onnx_subset::ModelProto& file) const {
    writeBytes(file.SerializeAsString());
    return refusal();
  }

  std::filesystem::path folder_;
  std::string path_;
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
