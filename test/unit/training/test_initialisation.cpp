#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/parameter_vector.hpp"

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
  EXPECT_THROW(makeLstmStack(0, {8}, 5), std::invalid_argument);
  EXPECT_THROW(makeLstmStack(4, {8, 0}, 5), std::invalid_argument);
  EXPECT_THROW(makeDenseStack(4, {8}, -1), std::invalid_argument);
  const LayerStack layers = makeLstmStack(4, {3}, 2);
  InitialisationParameters parameters;
  parameters.range = 0.0;
  EXPECT_THROW(initialised(layers, 1, parameters), std::invalid_argument);
  parameters = {};
  parameters.forget_gate_bias = std::numeric_limits<double>::infinity();
  EXPECT_THROW(initialised(layers, 1, parameters), std::invalid_argument);
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

TEST(NetworkShape, RefusesActivationsOfLayersThatItDoesNotHave) {
  NetworkShape lstm;
  lstm.activation = Activation::kRelu;
  EXPECT_THROW(makeNetwork(3, lstm, 2), std::invalid_argument);
  NetworkShape perceptron;
  perceptron.kind = NetworkShape::Kind::kMlp;
  perceptron.activation = Activation::kRelu;
  EXPECT_NO_THROW(makeNetwork(3, perceptron, 2));
  perceptron.candidate = Activation::kSigmoid;
  EXPECT_THROW(makeNetwork(3, perceptron, 2), std::invalid_argument);
  perceptron.candidate = Activation::kTanh;
  perceptron.activation = Activation::kIdentity;  // layers without one are a single layer
  EXPECT_THROW(makeNetwork(3, perceptron, 2), std::invalid_argument);
}

TEST(NetworkShape, RefusesWhatIsNoNetwork) {
  NetworkShape shape;
  shape.cells = {};
  EXPECT_THROW(makeNetwork(3, shape, 2), std::invalid_argument);
  shape.cells = {8};
  shape.deep_out = {0};
  EXPECT_THROW(makeNetwork(3, shape, 2), std::invalid_argument);
  shape.deep_out = {4};
  EXPECT_NO_THROW(makeNetwork(3, shape, 2));
  shape.kind = NetworkShape::Kind::kMlp;  // has no recurrent layer to be behind
  EXPECT_THROW(makeNetwork(3, shape, 2), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_initialisation
