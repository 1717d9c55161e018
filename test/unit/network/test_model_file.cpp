#include <limits>
#include <variant>

#include "lstm_planner/network/network.hpp"
#include "unit/network/model_file_fixtures.hpp"
#include "unit/network/network_fixtures.hpp"

namespace lstm_planner::test_model_file {
namespace {

using test::LayerMaker;
namespace fs = std::filesystem;

class ModelFile : public test::ModelFileTest {};

/// Bit by bit the same preferences for 50 steps.
void expectSameNetwork(const LayerStack& layers, const LayerStack& others) {
  ASSERT_EQ(layers.size(), others.size());
  Network network(layers);
  Network other(others);
  LayerMaker make(99);
  for (int step = 0; step < 50; ++step) {
    const Eigen::VectorXf input = make.input(network.inputSize());
    ASSERT_EQ(Eigen::VectorXf(network.forward(input)), Eigen::VectorXf(other.forward(input)));
  }
}

TEST_F(ModelFile, EveryKindOfLayerComesBackTheSame) {
  LayerMaker make(1);
  const std::vector<LayerStack> stacks = {
      make.thesisNet(),
      {make.lstm(11, 8, Activation::kSigmoid)},
      {make.recurrent(3, 5), make.recurrent(5, 2)},
      {make.dense(11, 4, Activation::kRelu), make.dense(4, 4, Activation::kTanh),
       make.dense(4, 2, Activation::kSigmoid)},
      {make.dense(11, 6, Activation::kTanh), make.lstm(6, 8), make.recurrent(8, 5), make.dense(5, 8), SoftmaxLayer{}},
      {make.lstm(1, 1), SoftmaxLayer{}, make.lstm(1, 3)},
  };
  for (const LayerStack& layers : stacks) {
    writeModelFile(path_, {layers, {}});
    expectSameNetwork(layers, readModelFile(path_).layers);
  }
}

TEST_F(ModelFile, MetadataComeBackTheSame) {
  const std::map<std::string, std::string> metadata = {
      {"encoder.range_cap", "10.0"}, {"training command", "lstm_planner train\n--seed 1"}, {"empty", ""}, {"ü", "°"}};
  writeModelFile(path_, {LayerMaker(1).thesisNet(), metadata});
  EXPECT_EQ(readModelFile(path_).metadata, metadata);
}

TEST_F(ModelFile, TheSameModelGivesTheSameBytes) {
  const Model model{LayerMaker(1).thesisNet(), {{"b", "2"}, {"a", "1"}}};
  writeModelFile(path_, model);
  const std::string first = readBytes();
  writeModelFile(path_, model);
  EXPECT_EQ(readBytes(), first);
}

TEST_F(ModelFile, StatesAreInputsAndOutputsOfTheGraph) {
  const auto file = written({LayerMaker(1).thesisNet(), {}});
  std::vector<std::string> names;
  for (const auto& input : file.graph().input()) names.push_back(input.name());
  for (const auto& output : file.graph().output()) names.push_back(output.name());
  EXPECT_EQ(names, (std::vector<std::string>{"observation", "layer_1_hidden", "layer_1_cell", "layer_2_hidden",
                                             "layer_2_cell", "preferences", "layer_1_hidden_next", "layer_1_cell_next",
                                             "layer_2_hidden_next", "layer_2_cell_next"}));
  EXPECT_EQ(file.ir_version(), 7);
  ASSERT_EQ(file.opset_import_size(), 1);
  EXPECT_EQ(file.opset_import(0).version(), 14);
}

TEST_F(ModelFile, InvalidLayersAreNotWrittenAndTheOldFileStays) {
  LayerMaker make(1);
  writeModelFile(path_, {make.thesisNet(), {}});
  const std::string before = readBytes();
  EXPECT_THROW(writeModelFile(path_, {{make.lstm(11, 8), make.dense(7, 8)}, {}}), ModelFileError);
  DenseLayer not_finite = make.dense(2, 2);
  not_finite.bias(0) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(writeModelFile(path_, {{not_finite}, {}}), ModelFileError);
  EXPECT_EQ(readBytes(), before);
}

TEST_F(ModelFile, NothingIsLeftBesideAFile) {
  writeModelFile(path_, {LayerMaker(1).thesisNet(), {}});
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(ModelFile, FailedWritesLeaveNothingBehind) {
  fs::create_directories(fs::path(path_) / "in the way");
  EXPECT_THROW(writeModelFile(path_, {LayerMaker(1).thesisNet(), {}}), ModelFileError);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
  EXPECT_THROW(writeModelFile(in("missing/model.onnx"), {LayerMaker(1).thesisNet(), {}}), ModelFileError);
}

TEST_F(ModelFile, MissingFilesAndFoldersAreRefused) {
  EXPECT_REFUSED(refusal(), "no such file");
  fs::create_directory(path_);
  EXPECT_REFUSED(refusal(), "it is a folder");
}

std::string lengthOf(std::size_t bytes) {
  std::string varint;
  for (; bytes >= 128; bytes >>= 7U) varint += static_cast<char>(bytes % 128 + 128);
  return varint + static_cast<char>(bytes);
}

std::string field(char tag, const std::string& content) { return tag + lengthOf(content.size()) + content; }

TEST_F(ModelFile, ShortFilesThatTakeMuchMemoryAreRefused) {
  const char kGraph = 0x3a;
  std::string nodes;
  for (int i = 0; i < 300000; ++i) nodes += field(0x0a, "");
  writeBytes(field(kGraph, nodes));
  EXPECT_REFUSED(refusal(), "more than 200000 nodes, attributes and other fields");
  const std::string integers = field(0x3a, std::string(300000, '\1'));  // packed int64_data
  writeBytes(field(kGraph, field(0x2a, integers)));
  EXPECT_REFUSED(refusal(), "more than 200000 nodes, attributes and other fields");
}

TEST_F(ModelFile, EmptyAndForeignFilesAreRefused) {
  writeBytes("");
  EXPECT_REFUSED(refusal(), "no graph");
  writeBytes("layers:\n  - lstm 8\n");
  EXPECT_REFUSED(refusal(), "");
  writeBytes(std::string(1000, '\xff'));
  EXPECT_REFUSED(refusal(), "not protobuf");
}

TEST_F(ModelFile, FilesTruncatedAnywhereAreRefused) {
  LayerMaker make(1);
  const Model model{{make.lstm(3, 2), make.dense(2, 2)}, {{"key", "value"}, {"other", "value"}}};
  writeModelFile(path_, model);
  const std::string whole = readBytes();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    writeBytes(whole.substr(0, size));
    ASSERT_NE(refusal(), "") << "after " << size << " of " << whole.size() << " bytes";
  }
}

TEST_F(ModelFile, HugeFilesAreRefusedUnread) {
  writeBytes("");
  fs::resize_file(path_, std::uintmax_t{1} << 33);
  EXPECT_REFUSED(refusal(), "8589934592 bytes");
}

}  // namespace
}  // namespace lstm_planner::test_model_file
