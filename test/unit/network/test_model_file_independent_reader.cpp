#include <nlohmann/json.hpp>

#include "lstm_planner/network/network.hpp"
#include "support/shell.hpp"
#include "unit/network/model_file_fixtures.hpp"
#include "unit/network/network_fixtures.hpp"

namespace lstm_planner::test_model_file_independent_reader {
namespace {

using test::LayerMaker;

class IndependentReader : public test::ModelFileTest {
 protected:
  /// Writes the model and 100 of its steps, and has check_onnx.py read both.
  void expectSameSteps(const LayerStack& layers) {
    writeModelFile(path_, {layers, {{"trained.by", "a test"}}});
    Network network(layers);
    LayerMaker make(50);
    nlohmann::json steps;
    for (int step = 0; step < 100; ++step) {
      const Eigen::VectorXf input = make.input(network.inputSize(), 2.0f);
      const Eigen::VectorXf& output = network.forward(input);
      steps["inputs"].push_back(std::vector<float>(input.data(), input.data() + input.size()));
      steps["outputs"].push_back(std::vector<float>(output.data(), output.data() + output.size()));
    }
    const std::string steps_path = in("steps.json");
    std::ofstream(steps_path) << steps;

    const std::string script = std::string(LSTM_PLANNER_SOURCE_DIR) + "/test/unit/network/check_onnx.py";
    // The distribution's python, which has python3-onnx, and not one that stands before it in PATH.
    const std::string command = "/usr/bin/python3 '" + script + "' '" + path_ + "' '" + steps_path + "'";
    const test::Outcome outcome = test::runShell(command);
    constexpr int kSkipped = 77;
    if (outcome.status == kSkipped) GTEST_SKIP() << "python3-onnx is not installed, or too old: " << outcome.output;
    EXPECT_EQ(outcome.status, 0) << outcome.output;
  }
};

TEST_F(IndependentReader, AcceptsAndRunsTheThesisNet) { expectSameSteps(LayerMaker(1).thesisNet()); }

TEST_F(IndependentReader, AcceptsAndRunsEveryOperator) {
  LayerMaker make(2);
  expectSameSteps({make.dense(11, 6, Activation::kRelu), make.lstm(6, 8, Activation::kSigmoid), make.recurrent(8, 5),
                   make.dense(5, 7, Activation::kTanh), make.dense(7, 7, Activation::kSigmoid), make.lstm(7, 4),
                   SoftmaxLayer{}});
}

TEST_F(IndependentReader, AcceptsAndRunsANetThatEndsInAnLstm) {
  LayerMaker make(3);
  expectSameSteps({make.lstm(3, 2)});
}

}  // namespace
}  // namespace lstm_planner::test_model_file_independent_reader
