#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "lstm_planner/network/network.hpp"
#include "unit/network/model_file_fixtures.hpp"

// Files that PyTorch exported, and files in the forms that tf2onnx gives to Keras models, with the answers that they
// must give: test/models/export_pytorch.py and keras_forms.py make both.

namespace lstm_planner::test_model_file_foreign {
namespace {

constexpr int kInputs = 14;
const std::string kModels = LSTM_PLANNER_SOURCE_DIR "/test/models/";

/// Step by step.
std::vector<std::vector<float>> answersOf(const std::string& name) {
  std::ifstream file(kModels + name.substr(0, name.find('_')) + "_outputs.csv");
  std::vector<std::vector<float>> answers;
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    std::string field;
    std::getline(fields, field, ',');
    if (field != name) continue;
    std::getline(fields, field, ',');  // the step
    answers.emplace_back();
    while (std::getline(fields, field, ',')) answers.back().push_back(std::stof(field));
  }
  return answers;
}

class ForeignModel : public ::testing::TestWithParam<const char*> {};

TEST_P(ForeignModel, AnswersHereAsItDoesThere) {
  const std::string name = GetParam();
  const std::vector<std::vector<float>> answers = answersOf(name);
  ASSERT_EQ(answers.size(), 6u);
  Network network(readModelFile(kModels + name).layers);
  for (std::size_t step = 0; step < answers.size(); ++step) {
    Eigen::VectorXf input(kInputs);
    for (int i = 0; i < kInputs; ++i)
      input[i] = static_cast<float>(std::sin(0.7 * i + 1.3 * static_cast<double>(step)));
    const Eigen::VectorXf output = network.forward(input);
    ASSERT_EQ(output.size(), static_cast<Eigen::Index>(answers[step].size()));
    // Our tanh is within 2e-7 of the exact one; a step adds some dozen products of values below 1.
    for (Eigen::Index i = 0; i < output.size(); ++i) {
      EXPECT_NEAR(output[i], answers[step][static_cast<std::size_t>(i)], 2e-6f) << "step " << step << ", output " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Exports, ForeignModel,
                         ::testing::Values("pytorch_states.onnx", "pytorch_opset_9.onnx", "pytorch_opset_11.onnx",
                                           "pytorch_opset_13.onnx", "pytorch_dynamic.onnx", "pytorch_sequence.onnx",
                                           "pytorch_two_inputs.onnx", "pytorch_unfolded.onnx",
                                           "pytorch_equal_biases.onnx", "keras_sequence.onnx", "keras_any_batch.onnx",
                                           "keras_stacked.onnx"),
                         [](const auto& instance) {
                           const std::string name = instance.param;
                           return name.substr(0, name.find('.'));
                         });

/// What is close to those files and is refused.
class PytorchRefusals : public test::ModelFileTest {
 protected:
  static onnx_subset::ModelProto load(const std::string& name) {
    std::ifstream file(kModels + name, std::ios::binary);
    onnx_subset::ModelProto model;
    EXPECT_TRUE(model.ParseFromIstream(&file)) << name;
    return model;
  }
  static onnx_subset::NodeProto& first(onnx_subset::ModelProto& file, const std::string& type) {
    for (auto& node : *file.mutable_graph()->mutable_node()) {
      if (node.op_type() == type) return node;
    }
    throw std::out_of_range("no " + type);
  }
};

TEST_F(PytorchRefusals, ABiasThatFollowsNoProduct) {
  onnx_subset::ModelProto file = load("pytorch_two_inputs.onnx");
  const std::string bias = first(file, "Gemm").input(2);
  first(file, "Relu").add_input(bias);
  first(file, "Relu").set_op_type("Add");
  EXPECT_NE(refusal(file).find("does not follow a MatMul"), std::string::npos) << refusal();
}

TEST_F(PytorchRefusals, BiasesAddedToAColumnWhichMakeATable) {
  onnx_subset::ModelProto file = load("keras_sequence.onnx");
  std::string& shape = *test::tensorNamed(file, "const__8").mutable_raw_data();  // of the product: 1 x 1 x 5
  std::swap_ranges(shape.begin() + 8, shape.begin() + 16, shape.begin() + 16);
  EXPECT_NE(refusal(file).find("adds biases to the shape [1, 5, 1]"), std::string::npos) << refusal();
}

TEST_F(PytorchRefusals, OneStateForTwoLayers) {
  onnx_subset::ModelProto file = load("pytorch_states.onnx");
  int lstms = 0;
  std::string state;
  for (auto& node : *file.mutable_graph()->mutable_node()) {
    if (node.op_type() != "LSTM") continue;
    if (lstms++ == 0) {
      state = node.input(5);
    } else {
      node.set_input(5, state);
    }
  }
  ASSERT_EQ(lstms, 2);
  EXPECT_NE(refusal(file).find("is used elsewhere already"), std::string::npos) << refusal();
}

TEST_F(PytorchRefusals, ConstantsThatWouldFillTheMemory) {
  onnx_subset::ModelProto file = load("pytorch_dynamic.onnx");
  onnx_subset::NodeProto constant;
  constant.set_op_type("Constant");
  constant.add_output("huge_shape");
  auto& value = *test::addAttribute(constant, "value").mutable_t();
  value.set_data_type(7);
  value.add_dims(2);
  value.add_int64_data(256);
  value.add_int64_data(256);
  const auto nodes = file.graph().node();
  file.mutable_graph()->clear_node();
  *file.mutable_graph()->add_node() = constant;
  for (int i = 0; i < 17; ++i) {
    onnx_subset::NodeProto& fill = *file.mutable_graph()->add_node();
    fill.set_op_type("ConstantOfShape");
    fill.add_input("huge_shape");
    fill.add_output("fill_" + std::to_string(i));
  }
  for (const auto& node : nodes) *file.mutable_graph()->add_node() = node;
  EXPECT_NE(refusal(file).find("values of constants"), std::string::npos) << refusal();
}

}  // namespace
}  // namespace lstm_planner::test_model_file_foreign
