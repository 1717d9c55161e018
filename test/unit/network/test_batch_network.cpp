#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/network/batch_network.hpp"
#include "lstm_planner/network/network.hpp"
#include "support/instruction_sets.hpp"
#include "unit/network/network_fixtures.hpp"

namespace lstm_planner::test_batch_network {
namespace {

using test::largestDifference;
using test::LayerMaker;
using test::ReferenceNetwork;
using Values = BatchNetwork::Values;

constexpr int kSteps = 1000;
constexpr double kTolerance = 1e-5;  // what the package promises of its networks

Values randomInputs(int rows, int agents, std::mt19937& random) {
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  return Values::NullaryExpr(rows, agents, [&] { return uniform(random); });
}

/// Sizes that are no multiple of anything that kernels work on, and every kind of layer.
std::vector<LayerStack> stacks() {
  LayerMaker make(1);
  return {make.thesisNet(),
          {make.lstm(11, 32), make.lstm(32, 32), make.dense(32, 8)},
          {make.dense(3, 13, Activation::kRelu), make.lstm(13, 7, Activation::kSigmoid),
           make.dense(7, 5, Activation::kSigmoid), SoftmaxLayer{}},
          {make.recurrent(2, 6), make.dense(6, 9, Activation::kTanh), make.lstm(9, 1)}};
}

class EveryInstructionSet : public testing::TestWithParam<InstructionSet> {};

INSTANTIATE_TEST_SUITE_P(BatchNetwork, EveryInstructionSet, testing::ValuesIn(runnableInstructionSets()),
                         test::instructionSetName);

TEST_P(EveryInstructionSet, KeepsCloseToDoublePrecisionForAThousandSteps) {
  for (const LayerStack& layers : stacks()) {
    for (const int agents : {1, 9, 67}) {
      BatchNetwork network(layers, agents, GetParam());
      ReferenceNetwork first(layers);
      ReferenceNetwork last(layers);
      std::mt19937 random(2);
      double difference = 0.0;
      for (int step = 0; step < kSteps; ++step) {
        const Values inputs = randomInputs(network.inputSize(), agents, random);
        const Values& outputs = network.forward(inputs);
        difference = std::max(difference, largestDifference(outputs.col(0), first.forward(inputs.col(0))));
        difference =
            std::max(difference, largestDifference(outputs.col(agents - 1), last.forward(inputs.col(agents - 1))));
      }
      EXPECT_LE(difference, kTolerance) << agents << " agents, " << network.outputSize() << " outputs";
    }
  }
}

TEST_P(EveryInstructionSet, AgentsDoNotDependOnEachOther) {
  constexpr int kAgents = 133;  // two of the widest tiles and a rest
  const LayerStack layers = stacks()[1];
  BatchNetwork together(layers, kAgents, GetParam());
  std::vector<BatchNetwork> alone(kAgents, BatchNetwork(layers, 1, GetParam()));
  std::mt19937 random(3);
  for (int step = 0; step < 20; ++step) {
    const Values inputs = randomInputs(together.inputSize(), kAgents, random);
    const Values& outputs = together.forward(inputs);
    for (int agent = 0; agent < kAgents; ++agent) {
      ASSERT_EQ(alone[static_cast<std::size_t>(agent)].forward(inputs.col(agent)), outputs.col(agent))
          << "agent " << agent << ", step " << step;
    }
  }
}

TEST_P(EveryInstructionSet, RefusesWhatIsNotFiniteAndKeepsItsStates) {
  constexpr int kAgents = 20;
  BatchNetwork network(stacks()[0], kAgents, GetParam());
  BatchNetwork undisturbed = network;
  std::mt19937 random(4);
  for (int step = 0; step < 5; ++step) {
    const Values inputs = randomInputs(network.inputSize(), kAgents, random);
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e38f}) {
      Values spoiled = inputs;
      spoiled(2, 17) = bad;
      EXPECT_THROW(network.forward(spoiled), std::invalid_argument);
    }
    ASSERT_EQ(network.forward(inputs), undisturbed.forward(inputs));
  }
}

TEST_P(EveryInstructionSet, SaturatesWithLargeInputs) {
  for (const LayerStack& layers : stacks()) {
    BatchNetwork network(layers, 8, GetParam());
    for (int step = 0; step < 10; ++step) {
      const Values inputs = Values::Constant(network.inputSize(), 8, step % 2 == 0 ? 1e30f : -1e30f);
      EXPECT_TRUE(network.forward(inputs).allFinite());
    }
    EXPECT_LE(network.hiddenState(0).cwiseAbs().maxCoeff(), 10.0f) << "a cell state grows by at most 1 a step";
  }
}

/// An input gate and a forget gate that are wide open add 1 a step; nothing may leak.
TEST_P(EveryInstructionSet, CountsWithOpenGates) {
  LstmLayer counter{Eigen::MatrixXf::Zero(4, 1), Eigen::MatrixXf::Zero(4, 1), Eigen::VectorXf::Constant(4, 30.0f)};
  BatchNetwork network({counter}, 3, GetParam());
  for (int step = 0; step < kSteps; ++step) network.forward(Values::Zero(1, 3));
  EXPECT_EQ(network.hiddenState(2)[1], static_cast<float>(kSteps));
}

TEST_P(EveryInstructionSet, FadesToZeroRatherThanToDenormals) {
  LayerMaker make(5);
  LstmLayer lstm = make.lstm(2, 3);
  lstm.bias.setZero();
  RecurrentLayer recurrent = make.recurrent(3, 3);
  recurrent.bias.setZero();
  BatchNetwork network({lstm, recurrent}, 2, GetParam());
  network.forward(Values::Ones(2, 2));
  for (int step = 0; step < kSteps; ++step) network.forward(Values::Zero(2, 2));
  EXPECT_EQ(network.hiddenState(1), BatchNetwork::HiddenState::Zero(9));
}

TEST(BatchNetwork, ForgetsAllAgentsOrTheOneWhoseStateIsSetToZero) {
  BatchNetwork network(stacks()[0], 10);
  std::mt19937 random(6);
  const Values inputs = randomInputs(network.inputSize(), 10, random);
  const Values first = network.forward(inputs);
  const Values second = network.forward(inputs);
  network.reset();
  EXPECT_EQ(network.forward(inputs), first);
  network.setHiddenState(4, BatchNetwork::HiddenState::Zero(network.hiddenStateSize()));
  const Values after = network.forward(inputs);
  EXPECT_EQ(after.col(4), first.col(4));
  EXPECT_EQ(after.col(3), second.col(3));
  EXPECT_EQ(after.col(5), second.col(5));
}

TEST(BatchNetwork, HandsHiddenStatesOnToAgentsAndNetworks) {
  const LayerStack layers = stacks()[3];
  BatchNetwork network(layers, 3);
  BatchNetwork other(layers, 70);
  Network single(layers);
  std::mt19937 random(7);
  for (int step = 0; step < 5; ++step) network.forward(randomInputs(2, 3, random));
  other.forward(randomInputs(2, 70, random));  // one of an odd, one of an even number of steps
  other.setHiddenState(68, network.hiddenState(1));
  single.setHiddenState(network.hiddenState(1));
  EXPECT_EQ(other.hiddenState(68), network.hiddenState(1));
  const Eigen::VectorXf input = randomInputs(2, 1, random);
  const Eigen::VectorXf output = network.forward(input.replicate(1, 3)).col(1);
  EXPECT_EQ(Eigen::VectorXf(other.forward(input.replicate(1, 70)).col(68)), output);
  EXPECT_LE((single.forward(input) - output).cwiseAbs().maxCoeff(), kTolerance);
}

TEST(BatchNetwork, RefusesStatesThatNoNetworkHas) {
  BatchNetwork network(stacks()[0], 2);
  BatchNetwork::HiddenState state = network.hiddenState(0);
  EXPECT_EQ(state.size(), 32);
  EXPECT_THROW(network.setHiddenState(0, BatchNetwork::HiddenState::Zero(31)), std::invalid_argument);
  state[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(network.setHiddenState(0, state), std::invalid_argument);
  state[3] = 3e7f;
  EXPECT_THROW(network.setHiddenState(0, state), std::invalid_argument);
  EXPECT_EQ(network.hiddenState(0), BatchNetwork::HiddenState::Zero(32));
}

TEST(BatchNetwork, SaysWhatIsWrong) {
  const LayerStack layers = stacks()[0];
  EXPECT_THROW(BatchNetwork(layers, 0), std::invalid_argument);
  EXPECT_THROW(BatchNetwork(layers, 1, static_cast<InstructionSet>(99)), std::invalid_argument);
  EXPECT_THROW(BatchNetwork({}, 1), std::invalid_argument);
  LayerStack too_large = layers;
  std::get<LstmLayer>(too_large[1]).bias[0] = 3e38f;
  EXPECT_THROW(BatchNetwork(too_large, 1), std::invalid_argument);

  BatchNetwork network(layers, 5);
  EXPECT_THROW(network.hiddenState(-1), std::out_of_range);
  EXPECT_THROW(network.forward(Values::Zero(11, 4)), std::invalid_argument);
  Values inputs = Values::Zero(11, 5);
  inputs(7, 3) = std::numeric_limits<float>::quiet_NaN();
  try {
    network.forward(inputs);
    FAIL() << "NaN went through";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "input 7 of agent 3 of the batch is not finite");
  }
}

}  // namespace
}  // namespace lstm_planner::test_batch_network
