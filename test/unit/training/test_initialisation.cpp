#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_initialisation {
namespace {

TEST(Initialisation, ForgetGatesStartOpenAndOtherBiasesAtZero) {
  const LayerStack layers = initialised(makeLstmStack(14, {8}, 5), 1);
  const auto& lstm = std::get<LstmLayer>(layers[0]);
  for (Eigen::Index row = 0; row < 32; ++row) EXPECT_EQ(lstm.bias[row], row >= 16 && row < 24 ? 1.0f : 0.0f) << row;
  EXPECT_TRUE((std::get<DenseLayer>(layers[1]).bias.array() == 0.0f).all());
}

TEST(Initialisation, XavierFillsItsRangeForEachGate) {
  const LayerStack layers = initialised(makeLstmStack(40, {40}, 5), 1);
  const Eigen::MatrixXf& weights = std::get<LstmLayer>(layers[0]).input;
  const double range = std::sqrt(6.0 / (40 + 40));
  EXPECT_LE(weights.cwiseAbs().maxCoeff(), range);
  // Variance of a uniform number is range^2 / 3; 6,400 of them give it within 5 % (4 standard deviations).
  EXPECT_NEAR(weights.squaredNorm() / static_cast<float>(weights.size()), range * range / 3.0,
              0.05 * range * range / 3.0);
}

TEST(Initialisation, UniformKeepsItsRange) {
  InitialisationParameters parameters;
  parameters.range = 0.05;
  const LayerStack layers = initialised(makeDenseStack(20, {30}, 5), 1, parameters);
  const float largest = parameterVector(layers).cwiseAbs().maxCoeff();
  EXPECT_LE(largest, 0.05f);
  EXPECT_GT(largest, 0.045f);
}

TEST(Initialisation, SeedDecidesTheWeights) {
  const LayerStack layers = initialised(makeLstmStack(4, {3}, 2), 7);
  EXPECT_EQ(parameterVector(initialised(layers, 7)), parameterVector(layers));
  EXPECT_NE(parameterVector(initialised(layers, 8)), parameterVector(layers));
}

TEST(Initialisation, RefusesImpossibleSizesAndRanges) {
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([] { makeLstmStack(0, {8}, 5); }),
            "layer size is 0, expected at least 1");
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([] {
              makeLstmStack(4, {8, 0}, 5);
            }),
            "layer size is 0, expected at least 1");
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([] { makeDenseStack(4, {8}, -1); }),
            "layer size is -1, expected at least 1");
  const LayerStack layers = makeLstmStack(4, {3}, 2);
  InitialisationParameters parameters;
  const auto refusal = [&] {
    return test::refusalOf<std::invalid_argument>([&] { initialised(layers, 1, parameters); });
  };
  parameters.range = 0.0;
  EXPECT_EQ(refusal(), "parameter range is 0, expected a positive number");
  parameters = {};
  parameters.forget_gate_bias = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal(), "forget_gate_bias is not finite, expected a number");
}

TEST(NetworkShape, TheThesissNetworksHaveTheirNumbersOfWeights) {
  NetworkShape shape;
  EXPECT_EQ(countWeights(makeNetwork(11, shape, 8)), 1256u);  // Eq. 3.22
  shape.kind = NetworkShape::Kind::kMlp;
  shape.cells = {64, 64, 64, 64};
  EXPECT_EQ(countWeights(makeNetwork(11, shape, 8)), 13768u);  // 3.2
}

TEST(NetworkShape, DeepInIsBeforeTheRecurrentLayersAndDeepOutBehind) {
  NetworkShape shape;
  shape.kind = NetworkShape::Kind::kRnn;
  shape.cells = {5, 6};
  shape.deep_in = {4};
  shape.deep_out = {7};
  const LayerStack layers = makeNetwork(3, shape, 2);
  ASSERT_EQ(layers.size(), 5u);
  EXPECT_EQ(std::get<DenseLayer>(layers[0]).weights.rows(), 4);
  EXPECT_EQ(std::get<RecurrentLayer>(layers[1]).input.rows(), 5);
  EXPECT_EQ(std::get<RecurrentLayer>(layers[2]).input.cols(), 5);
  EXPECT_EQ(std::get<DenseLayer>(layers[3]).weights.rows(), 7);
  EXPECT_EQ(std::get<DenseLayer>(layers[3]).activation, Activation::kTanh);
  EXPECT_EQ(std::get<DenseLayer>(layers[4]).activation, Activation::kIdentity);
  EXPECT_NO_THROW(validateLayers(layers));
  EXPECT_EQ(inputSize(layers), 3);
  EXPECT_EQ(outputSize(layers), 2);
}

TEST(NetworkShape, ActivationsAreThoseOfTheHiddenLayers) {
  NetworkShape shape;
  shape.deep_out = {7};
  shape.activation = Activation::kRelu;
  shape.candidate = Activation::kSigmoid;
  const LayerStack layers = makeNetwork(3, shape, 2);
  EXPECT_EQ(std::get<LstmLayer>(layers[0]).candidate, Activation::kSigmoid);
  EXPECT_EQ(std::get<LstmLayer>(layers[1]).candidate, Activation::kSigmoid);
  EXPECT_EQ(std::get<DenseLayer>(layers[2]).activation, Activation::kRelu);
  EXPECT_EQ(std::get<DenseLayer>(layers[3]).activation, Activation::kIdentity);
}

std::string refusalOf(const NetworkShape& shape) {
  return test::refusalOf<std::invalid_argument>([&] { makeNetwork(3, shape, 2); });
}

TEST(NetworkShape, RefusesActivationsOfLayersThatItDoesNotHave) {
  NetworkShape lstm;
  lstm.activation = Activation::kRelu;
  EXPECT_EQ(refusalOf(lstm), "a network has an activation of dense layers, but no dense layer besides the last");
  NetworkShape perceptron;
  perceptron.kind = NetworkShape::Kind::kMlp;
  perceptron.activation = Activation::kRelu;
  EXPECT_EQ(refusalOf(perceptron), "");
  perceptron.candidate = Activation::kSigmoid;
  EXPECT_EQ(refusalOf(perceptron), "a network has a candidate that is not tanh, but no LSTM layer");
  perceptron.candidate = Activation::kTanh;
  perceptron.activation = Activation::kIdentity;  // layers without one are a single layer
  EXPECT_EQ(refusalOf(perceptron), "a network's dense layers have no activation, expected tanh, sigmoid or relu");
}

TEST(NetworkShape, RefusesWhatIsNoNetwork) {
  NetworkShape shape;
  shape.cells = {};
  EXPECT_EQ(refusalOf(shape), "a network has no cells, expected at least one layer of them");
  shape.cells = {8};
  shape.deep_out = {0};
  EXPECT_EQ(refusalOf(shape), "layer size is 0, expected at least 1");
  shape.deep_out = {4};
  EXPECT_EQ(refusalOf(shape), "");
  shape.kind = NetworkShape::Kind::kMlp;
  EXPECT_EQ(refusalOf(shape),
            "an mlp has deep-in or deep-out layers, expected none: it has no recurrent layer that they are before or "
            "behind");
}

}  // namespace
}  // namespace lstm_planner::test_initialisation
