#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "lstm_planner/network/network.hpp"
#include "support/refusal.hpp"
#include "unit/network/network_fixtures.hpp"

namespace lstm_planner::test_network {
namespace {

using Eigen::VectorXf;
using test::largestDifference;
using test::LayerMaker;
using test::ReferenceNetwork;

/// Single precision against double, per step.
constexpr double kTolerance = 1e-5;

void expectEqualToReference(const LayerStack& layers, unsigned seed) {
  LayerMaker make(seed);
  Network network(layers);
  ReferenceNetwork reference(layers);
  double largest = 0.0;
  for (int step = 0; step < 1000; ++step) {
    const VectorXf input = make.input(network.inputSize());
    largest = std::max(largest, largestDifference(network.forward(input), reference.forward(input.cast<double>())));
  }
  EXPECT_LT(largest, kTolerance);
}

TEST(Network, LstmWithTanhCandidateEqualsReference) { expectEqualToReference({LayerMaker(1).lstm(11, 8)}, 2); }

TEST(Network, LstmWithSigmoidCandidateEqualsReference) {
  expectEqualToReference({LayerMaker(3).lstm(11, 8, Activation::kSigmoid)}, 4);
}

TEST(Network, RecurrentLayerEqualsReference) { expectEqualToReference({LayerMaker(5).recurrent(11, 8)}, 6); }

TEST(Network, DenseActivationsEqualReference) {
  for (const Activation activation :
       {Activation::kIdentity, Activation::kTanh, Activation::kSigmoid, Activation::kRelu}) {
    expectEqualToReference({LayerMaker(7).dense(11, 8, activation)}, 8);
  }
}

TEST(Network, ThesisNetEqualsReference) { expectEqualToReference(LayerMaker(9).thesisNet(), 10); }

TEST(Network, DeepInDeepOutStackEqualsReference) {
  LayerMaker make(11);
  expectEqualToReference(
      {make.dense(11, 6, Activation::kRelu), make.lstm(6, 8), make.recurrent(8, 5),
       make.lstm(5, 7, Activation::kSigmoid), make.dense(7, 9, Activation::kTanh), make.dense(9, 8), SoftmaxLayer{}},
      12);
}

TEST(Network, OneCellOnOneInputEqualsReference) {
  LayerMaker make(13);
  expectEqualToReference({make.lstm(1, 1), make.recurrent(1, 1), make.dense(1, 1)}, 14);
}

TEST(Network, SaturatedGatesEqualReference) {
  // Odd multiples of 1/8 times 1e4 are exact in single precision, and no eleven of them add up to zero, so that both
  // sides saturate to the same side.
  for (const Activation candidate : {Activation::kTanh, Activation::kSigmoid}) {
    LayerMaker make(15);
    LstmLayer lstm = make.lstm(11, 8, candidate);
    RecurrentLayer recurrent = make.recurrent(8, 8);
    DenseLayer dense = make.dense(8, 8, Activation::kSigmoid);
    for (Eigen::MatrixXf* weights : {&lstm.input, &recurrent.input, &dense.weights}) {
      *weights = ((*weights * 8.0f).array().floor() * 2.0f + 1.0f) * 0.125f;
    }
    const LayerStack layers = {lstm, recurrent, dense};
    Network network(layers);
    ReferenceNetwork reference(layers);
    for (int step = 0; step < 1000; ++step) {
      const VectorXf input = make.input(11).unaryExpr([](float value) { return value < 0.0f ? -1e4f : 1e4f; });
      ASSERT_LT(largestDifference(network.forward(input), reference.forward(input.cast<double>())), kTolerance)
          << "step " << step;
    }
  }
}

TEST(Network, ActivationsReachTheirLimitsAtHugeSums) {
  const Eigen::MatrixXf one = Eigen::MatrixXf::Ones(1, 1);
  const VectorXf no_bias = VectorXf::Zero(1);
  Network sigmoid({DenseLayer{one, no_bias, Activation::kSigmoid}});
  Network tanh({DenseLayer{one, no_bias, Activation::kTanh}});
  for (const float size : {1e2f, 1e4f, 1e30f}) {
    EXPECT_EQ(sigmoid.forward(VectorXf::Constant(1, size))(0), 1.0f);
    EXPECT_NEAR(sigmoid.forward(VectorXf::Constant(1, -size))(0), 0.0f, 1e-30f);
    EXPECT_NEAR(tanh.forward(VectorXf::Constant(1, size))(0), 1.0f, 1e-6f);
    EXPECT_NEAR(tanh.forward(VectorXf::Constant(1, -size))(0), -1.0f, 1e-6f);
  }
}

TEST(Network, SoftmaxOfHugePreferencesIsAProbability) {
  Network network({DenseLayer{Eigen::MatrixXf::Identity(3, 3), VectorXf::Zero(3)}, SoftmaxLayer{}});
  EXPECT_TRUE(network.forward(Eigen::Vector3f(1e4f, 1e4f, -1e4f)).isApprox(Eigen::Vector3f(0.5f, 0.5f, 0.0f)));
  EXPECT_TRUE(network.forward(Eigen::Vector3f::Constant(-1e4f)).isApprox(Eigen::Vector3f::Constant(1.0f / 3.0f)));
}

TEST(Network, ZeroWeightsAndZeroInputGiveZero) {
  LstmLayer lstm{Eigen::MatrixXf::Zero(32, 11), Eigen::MatrixXf::Zero(32, 8), VectorXf::Zero(32), Activation::kTanh};
  Network network({lstm});
  for (int step = 0; step < 10; ++step) EXPECT_TRUE(network.forward(VectorXf::Zero(11)).isZero(0.0f));
  EXPECT_TRUE(network.hiddenState().isZero(0.0f));
}

TEST(Network, AllZeroInputEqualsReference) {
  const LayerStack layers = LayerMaker(17).thesisNet();
  Network network(layers);
  ReferenceNetwork reference(layers);
  for (int step = 0; step < 100; ++step) {
    const VectorXf input = VectorXf::Zero(11);
    ASSERT_LT(largestDifference(network.forward(input), reference.forward(input.cast<double>())), kTolerance);
  }
}

TEST(Network, ConstantInputConvergesAndStaysForAMillionSteps) {
  LayerMaker make(19);
  LayerStack layers = make.thesisNet();
  layers[1] = make.lstm(8, 8, Activation::kSigmoid);
  const VectorXf input = make.input(11);
  Network network(layers);
  ReferenceNetwork reference(layers);
  Eigen::VectorXd fixed_point;
  for (int step = 0; step < 10000; ++step) fixed_point = reference.forward(input.cast<double>());
  ASSERT_EQ(reference.forward(input.cast<double>()), fixed_point) << "the reference has not converged";

  for (int step = 0; step < 10000; ++step) network.forward(input);
  const Network::HiddenState converged = network.hiddenState();
  for (int step = 10000; step < 1000000; ++step) network.forward(input);
  EXPECT_LT((network.hiddenState() - converged).cwiseAbs().maxCoeff(), 1e-6f);
  EXPECT_LT(largestDifference(network.forward(input), fixed_point), kTolerance);
}

TEST(Network, ChangingInputsStayEqualToReferenceForAMillionSteps) {
  LayerMaker make(21);
  const LayerStack layers = {make.lstm(4, 3), make.dense(3, 2)};
  Network network(layers);
  ReferenceNetwork reference(layers);
  double largest = 0.0;
  for (int step = 0; step < 1000000; ++step) {
    const VectorXf input = make.input(4, 10.0f);
    largest = std::max(largest, largestDifference(network.forward(input), reference.forward(input.cast<double>())));
  }
  EXPECT_LT(largest, kTolerance);
}

TEST(Network, ResetMakesTheNextStepsThoseOfANewNetwork) {
  LayerMaker make(23);
  const LayerStack layers = make.thesisNet();
  Network used(layers);
  Network fresh(layers);
  for (int step = 0; step < 20; ++step) used.forward(make.input(11));
  const VectorXf input = make.input(11);
  const VectorXf first = fresh.forward(input);
  EXPECT_NE(VectorXf(used.forward(input)), first);
  used.reset();
  EXPECT_TRUE(used.hiddenState().isZero(0.0f));
  EXPECT_EQ(VectorXf(used.forward(input)), first);
}

TEST(Network, TheHiddenStateIsThatOfAllRecurrentLayers) {
  LayerMaker make(25);
  const Network network({make.lstm(11, 8), make.recurrent(8, 6), make.dense(6, 8)});
  EXPECT_EQ(network.hiddenState().size(), 2 * 8 + 6);
}

TEST(Network, SequencesStepByThemselvesAndForgetTogether) {
  LayerMaker make(37);
  Network network(make.thesisNet(), fastestInstructionSet(), 3);
  EXPECT_EQ(network.sequences(), 3);
  const VectorXf input = make.input(11);
  const VectorXf first = network.forward(input, 0);
  for (const int other : {1, 2}) EXPECT_EQ(VectorXf(network.forward(input, other)), first);
  const VectorXf second = network.forward(input, 2);
  EXPECT_EQ(VectorXf(network.forward(input, 1)), second);
  EXPECT_EQ(network.hiddenState(0).size(), 32);
  network.reset();
  for (const int any : {0, 1, 2}) EXPECT_EQ(VectorXf(network.forward(input, any)), first);
}

TEST(Network, SequencesThatThereAreNotAreRefused) {
  const LayerStack layers = LayerMaker(39).thesisNet();
  EXPECT_THROW(Network(layers, fastestInstructionSet(), 0), std::invalid_argument);
  Network network(layers, fastestInstructionSet(), 2);
  for (const int no_sequence : {-1, 2}) {
    EXPECT_THROW(network.forward(VectorXf::Zero(11), no_sequence), std::out_of_range);
    EXPECT_THROW(network.hiddenState(no_sequence), std::out_of_range);
  }
}

TEST(Network, BadInputsAreRefusedAndChangeNothing) {
  LayerMaker make(29);
  Network network(make.thesisNet());
  for (int step = 0; step < 5; ++step) network.forward(make.input(11));
  const Network::HiddenState before = network.hiddenState();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity}) {
    VectorXf input = make.input(11);
    input(10) = bad;
    EXPECT_THROW(network.forward(input), std::invalid_argument);
    EXPECT_EQ(network.hiddenState(), before);
  }
  EXPECT_THROW(network.forward(make.input(10)), std::invalid_argument);
  EXPECT_EQ(network.hiddenState(), before);
}

TEST(Network, InputThatOverflowsADeepLayerLeavesAllLayersUnchanged) {
  LayerMaker make(31);
  DenseLayer amplifier = make.dense(8, 4);
  amplifier.weights.setConstant(std::numeric_limits<float>::max());
  LstmLayer lstm = make.lstm(1, 8);
  lstm.input.setConstant(10.0f);
  Network network({lstm, amplifier});
  EXPECT_THROW(network.forward(VectorXf::Constant(1, 1e3f)), std::invalid_argument);
  EXPECT_TRUE(network.hiddenState().isZero(0.0f));
}

TEST(Network, ItsOwnOutputIsAValidInput) {
  LayerMaker make(33);
  for (const int width : {8, 100}) {
    const LayerStack layers = {make.dense(width, width)};
    Network network(layers);
    ReferenceNetwork reference(layers);
    const VectorXf& first = network.forward(make.input(width));
    const VectorXf input = first;
    EXPECT_LT(largestDifference(network.forward(first), reference.forward(input.cast<double>())), kTolerance);
  }
}

TEST(Network, LayersThatDoNotFitAreRefused) {
  LayerMaker make(35);
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] {
              Network({make.lstm(11, 8), make.dense(7, 8)});
            }),
            "layer 2 (dense) takes 7 values, but the layer before it gives 8");
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([] { Network(LayerStack{}); }),
            "the network has no layers, expected at least one");
}

}  // namespace
}  // namespace lstm_planner::test_network
