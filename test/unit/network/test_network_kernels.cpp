#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/network/network.hpp"
#include "support/instruction_sets.hpp"
#include "unit/network/network_fixtures.hpp"

// Every kernel that this machine can run, whichever it would choose by itself.

namespace lstm_planner::test_network_kernels {
namespace {

using Eigen::VectorXf;
using test::largestDifference;
using test::LayerMaker;
using test::ReferenceNetwork;

constexpr double kTolerance = 1e-5;
constexpr int kSteps = 1000;

class NetworkKernels : public testing::TestWithParam<InstructionSet> {
 protected:
  /// Input 0 is the last output, so that errors go round.
  double largestErrorOfChainedSteps(const LayerStack& layers, unsigned seed) const {
    LayerMaker make(seed);
    Network network(layers, GetParam());
    ReferenceNetwork reference(layers);
    double largest = 0.0;
    float last_output = 0.0f;
    for (int step = 0; step < kSteps; ++step) {
      VectorXf input = make.input(network.inputSize());
      input(0) = last_output;
      const VectorXf& output = network.forward(input);
      largest = std::max(largest, largestDifference(output, reference.forward(input.cast<double>())));
      last_output = output(0);
    }
    return largest;
  }
};

TEST_P(NetworkKernels, TwoLstmsOfAnySizeEqualTheReference) {
  for (const int cells : {1, 3, 5, 8, 16, 24, 32, 33, 48, 64, 100}) {
    LayerMaker make(static_cast<unsigned>(cells));
    const LayerStack layers = {make.lstm(11, cells), make.lstm(cells, cells), make.dense(cells, 8)};
    EXPECT_LT(largestErrorOfChainedSteps(layers, 2), kTolerance) << cells << " cells";
  }
}

TEST_P(NetworkKernels, AllKindsOfLayersOfAnySizeEqualTheReference) {
  for (const int units : {1, 3, 5, 8, 16, 32, 33, 64, 100}) {
    LayerMaker make(static_cast<unsigned>(units));
    const LayerStack layers = {make.dense(7, units, Activation::kRelu),
                               make.recurrent(units, units),
                               make.lstm(units, units, Activation::kSigmoid),
                               make.dense(units, units, Activation::kTanh),
                               make.dense(units, units, Activation::kSigmoid),
                               make.dense(units, units),
                               SoftmaxLayer{}};
    EXPECT_LT(largestErrorOfChainedSteps(layers, 3), kTolerance) << units << " units";
  }
}

TEST_P(NetworkKernels, RecurrentLayersAtTheEndEqualTheReference) {
  LayerMaker make(4);
  EXPECT_LT(largestErrorOfChainedSteps({make.dense(5, 9), make.lstm(9, 13)}, 5), kTolerance);
  EXPECT_LT(largestErrorOfChainedSteps({make.recurrent(5, 9), make.recurrent(9, 17), make.recurrent(17, 3)}, 6),
            kTolerance);
}

TEST_P(NetworkKernels, TwoLstmsOfEightCellsAndAnyOtherSizesEqualTheReference) {
  for (const int inputs : {1, 2, 8, 11, 500}) {
    for (const int outputs : {1, 4, 5, 8, 9}) {
      for (const Activation activation : {Activation::kIdentity, Activation::kTanh, Activation::kRelu}) {
        LayerMaker make(static_cast<unsigned>(inputs));
        const LayerStack layers = {make.lstm(inputs, 8), make.lstm(8, 8), make.dense(8, outputs, activation)};
        EXPECT_LT(largestErrorOfChainedSteps(layers, 12), kTolerance) << inputs << " inputs, " << outputs << " outputs";
      }
    }
  }
}

TEST_P(NetworkKernels, SaturatedSumsGiveTheLimitsOfActivations) {
  // With all gates wide open a cell gains the candidate's limit in each step; 1 - tanh(9) is less than 1e-7.
  for (const float input : {1e2f, 1e6f, 1e30f}) {
    for (const float sign : {1.0f, -1.0f}) {
      LstmLayer lstm{Eigen::MatrixXf::Ones(12, 1), Eigen::MatrixXf::Zero(12, 3), VectorXf::Zero(12)};
      lstm.input.bottomRows(3) *= sign;
      Network network({lstm}, GetParam());
      for (int step = 1; step <= 100; ++step) {
        network.forward(VectorXf::Constant(1, input));
        ASSERT_EQ(network.hiddenState()(3), sign * static_cast<float>(step)) << "input " << input;
      }
      EXPECT_EQ(network.hiddenState()(0), sign);
    }
  }
}

TEST_P(NetworkKernels, SumsBeyondFloatAndBadInputsChangeNothing) {
  LayerMaker make(7);
  for (const int cells : {3, 8, 33}) {
    LayerStack layers = {make.lstm(11, cells), make.lstm(cells, cells), make.dense(cells, 8)};
    std::get<DenseLayer>(layers[2]).weights(7, cells - 1) = 3e38f;
    std::get<DenseLayer>(layers[2]).bias(7) = std::numeric_limits<float>::max();
    std::get<LstmLayer>(layers[1]).bias.setConstant(100.0f);
    layers.push_back(layers[2]);
    std::get<DenseLayer>(layers[3]) = make.dense(8, 8);
    Network network(layers, GetParam());
    VectorXf input = make.input(11);
    EXPECT_THROW(network.forward(input), std::invalid_argument);
    EXPECT_TRUE(network.hiddenState().isZero(0.0f));

    layers.pop_back();
    layers[2] = make.dense(cells, 8);
    Network sound(layers, GetParam());
    Network untroubled(layers, GetParam());
    for (int step = 0; step < 5; ++step) {
      for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                              -std::numeric_limits<float>::infinity()}) {
        VectorXf bad_input = input;
        bad_input(step) = bad;
        EXPECT_THROW(sound.forward(bad_input), std::invalid_argument);
      }
      EXPECT_EQ(VectorXf(sound.forward(input)), untroubled.forward(input));
      EXPECT_EQ(VectorXf(sound.hiddenState()), untroubled.hiddenState());
    }
  }
}

TEST_P(NetworkKernels, DenormalInputsCountAsZero) {
  LayerMaker make(8);
  const LayerStack layers = make.thesisNet();
  Network network(layers, GetParam());
  Network at_zero(layers, GetParam());
  for (const float denormal : {1e-38f, -1e-40f, std::numeric_limits<float>::denorm_min()}) {
    const VectorXf output = network.forward(VectorXf::Constant(11, denormal));
    EXPECT_EQ(output, at_zero.forward(VectorXf::Zero(11)));
  }
}

TEST_P(NetworkKernels, StatesThatFadeBecomeZeroAndAreNeverDenormal) {
  LayerMaker make(9);
  LayerStack layers = make.thesisNet();
  for (int layer : {0, 1}) std::get<LstmLayer>(layers[static_cast<std::size_t>(layer)]).bias.setZero();
  Network network(layers, GetParam());
  network.forward(make.input(11));
  for (int step = 0; step < 500; ++step) {
    network.forward(VectorXf::Zero(11));
    const VectorXf state = network.hiddenState();
    for (Eigen::Index i = 0; i < state.size(); ++i) {
      ASSERT_TRUE(state(i) == 0.0f || std::abs(state(i)) >= std::numeric_limits<float>::min()) << "step " << step;
    }
  }
  EXPECT_TRUE(network.hiddenState().isZero(0.0f));
}

TEST_P(NetworkKernels, TheSameStepsGiveTheSameBits) {
  for (const int cells : {5, 8, 32, 64}) {
    LayerMaker make(10);
    const LayerStack layers = {make.lstm(11, cells), make.lstm(cells, cells), make.dense(cells, 8)};
    Network one(layers, GetParam());
    Network another(layers, GetParam());
    for (int step = 0; step < 100; ++step) {
      const VectorXf input = make.input(11);
      const VectorXf output = one.forward(input);
      ASSERT_EQ(output, another.forward(input)) << cells << " cells, step " << step;
    }
  }
}

TEST_P(NetworkKernels, CopiesAreIndependent) {
  LayerMaker make(11);
  Network network(make.thesisNet(), GetParam());
  for (int step = 0; step < 3; ++step) network.forward(make.input(11));
  Network copy = network;
  Network assigned(make.thesisNet(), GetParam());
  assigned = network;
  const VectorXf input = make.input(11);
  const VectorXf expected = network.forward(input);
  network.forward(make.input(11));
  EXPECT_EQ(VectorXf(copy.forward(input)), expected);
  EXPECT_EQ(VectorXf(assigned.forward(input)), expected);
}

TEST_P(NetworkKernels, SequencesOfOneNetworkEqualNetworksOfTheirOwn) {
  constexpr int kSequences = 3;
  LayerMaker make(13);
  for (const LayerStack& layers : {make.thesisNet(), LayerStack{make.dense(11, 6), make.lstm(6, 33), make.dense(33, 1)},
                                   LayerStack{make.recurrent(11, 9), make.lstm(9, 5), SoftmaxLayer{}}}) {
    Network together(layers, GetParam(), kSequences);
    std::vector<Network> alone(kSequences, Network(layers, GetParam()));
    std::mt19937 random(14);
    for (int step = 0; step < 200; ++step) {
      const int sequence = std::uniform_int_distribution<int>(0, kSequences - 1)(random);
      Network& single = alone[static_cast<std::size_t>(sequence)];
      const VectorXf input = make.input(11);
      ASSERT_EQ(together.forward(input, sequence), single.forward(input)) << "step " << step;
      ASSERT_EQ(together.hiddenState(sequence), single.hiddenState()) << "step " << step;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Runnable, NetworkKernels, testing::ValuesIn(runnableInstructionSets()),
                         test::instructionSetName);

TEST(NetworkKernel, ThatTheMachineCannotRunIsRefused) {
  const auto& runnable = runnableInstructionSets();
  bool all = true;
  for (const InstructionSet set : {InstructionSet::kBaseline, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (std::find(runnable.begin(), runnable.end(), set) != runnable.end()) continue;
    all = false;
    EXPECT_THROW(Network(LayerMaker(12).thesisNet(), set), std::invalid_argument) << toString(set);
  }
  if (all) GTEST_SKIP() << "this machine can run all of them";
}

}  // namespace
}  // namespace lstm_planner::test_network_kernels
