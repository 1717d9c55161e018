#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "lstm_planner/network/layers.hpp"
#include "support/refusal.hpp"
#include "unit/network/network_fixtures.hpp"

namespace lstm_planner::test_layers {
namespace {

using test::LayerMaker;

std::string refusal(const LayerStack& layers) {
  return test::refusalOf<std::invalid_argument>([&] { validateLayers(layers); });
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Layers, ThesisLstmHas1256Weights) {
  LayerMaker make(1);
  EXPECT_EQ(countWeights(make.thesisNet()), 1256u);  // Eq. 3.19-3.22
}

TEST(Layers, ThesisPerceptronHas13768Weights) {
  LayerMaker make(1);
  const LayerStack perceptron = {make.dense(11, 64, Activation::kRelu),
                                 make.dense(64, 64, Activation::kRelu),
                                 make.dense(64, 64, Activation::kRelu),
                                 make.dense(64, 64, Activation::kRelu),
                                 make.dense(64, 8),
                                 SoftmaxLayer{}};
  EXPECT_EQ(countWeights(perceptron), 13768u);  // Eq. 3.17 and the sum below it
}

TEST(Layers, RecurrentLayerHasOneGateOfWeights) {
  LayerMaker make(1);
  EXPECT_EQ(countWeights({make.recurrent(11, 8)}), 8u * (1 + 8 + 11));
}

TEST(Layers, SizesAreThoseOfTheFirstAndLastLayerWithWeights) {
  LayerMaker make(1);
  const LayerStack layers = {make.dense(11, 5), make.lstm(5, 4), make.dense(4, 3), SoftmaxLayer{}};
  EXPECT_EQ(inputSize(layers), 11);
  EXPECT_EQ(outputSize(layers), 3);
}

TEST(Layers, SizesOfNothingAreRefused) {
  EXPECT_THROW(inputSize({}), std::invalid_argument);
  EXPECT_THROW(outputSize({}), std::invalid_argument);
  EXPECT_THROW(inputSize({SoftmaxLayer{}}), std::invalid_argument);
  EXPECT_THROW(outputSize({SoftmaxLayer{}}), std::invalid_argument);
}

TEST(Layers, DenseLayersMayStandBeforeAndAfterRecurrentOnes) {
  LayerMaker make(1);
  EXPECT_EQ(refusal({make.dense(11, 6, Activation::kRelu), make.lstm(6, 8), make.recurrent(8, 4),
                     make.dense(4, 6, Activation::kTanh), make.dense(6, 8), SoftmaxLayer{}}),
            "");
}

TEST(Layers, LayersThatDoNotFitTogetherAreNamed) {
  LayerMaker make(1);
  const std::string reason = refusal({make.lstm(11, 8), make.dense(7, 8)});
  EXPECT_TRUE(contains(reason, "layer 2 (dense) takes 7 values") && contains(reason, "gives 8")) << reason;
}

TEST(Layers, WidthPassesThroughASoftmax) {
  LayerMaker make(1);
  EXPECT_TRUE(
      contains(refusal({make.dense(4, 8), SoftmaxLayer{}, make.dense(4, 2)}), "layer 3 (dense) takes 4 values"));
}

TEST(Layers, NothingAndASoftmaxAloneAreRefused) {
  EXPECT_TRUE(contains(refusal({}), "no layers"));
  EXPECT_TRUE(contains(refusal({SoftmaxLayer{}}), "layer 1 (softmax) is the first layer"));
}

TEST(Layers, LayersWithoutUnitsAreRefused) {
  EXPECT_TRUE(contains(refusal({LstmLayer{}}), "layer 1 (LSTM) has no"));
  EXPECT_TRUE(contains(refusal({RecurrentLayer{}}), "layer 1 (recurrent) has no"));
  EXPECT_TRUE(contains(refusal({DenseLayer{}}), "layer 1 (dense) has no"));
}

TEST(Layers, WrongShapeNamesTheWeightsAndBothShapes) {
  LstmLayer layer = LayerMaker(1).lstm(11, 8);
  layer.bias.resize(31);
  layer.bias.setZero();
  EXPECT_EQ(refusal({layer}), "layer 1 (LSTM): biases are 31 x 1, expected 32 x 1");
  layer = LayerMaker(1).lstm(11, 8);
  layer.input = Eigen::MatrixXf::Zero(24, 11);
  EXPECT_EQ(refusal({layer}), "layer 1 (LSTM): input weights are 24 x 11, expected 32 x 11");
}

TEST(Layers, WeightsThatAreNotFiniteAreRefused) {
  LayerMaker make(1);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    LstmLayer lstm = make.lstm(3, 2);
    lstm.recurrent(1, 1) = bad;
    EXPECT_TRUE(contains(refusal({lstm}), "recurrent weights hold a value that is not finite"));
    RecurrentLayer recurrent = make.recurrent(3, 2);
    recurrent.bias(0) = bad;
    EXPECT_TRUE(contains(refusal({recurrent}), "biases hold a value that is not finite"));
    DenseLayer dense = make.dense(3, 2);
    dense.weights(0, 2) = bad;
    EXPECT_TRUE(contains(refusal({dense}), "weights hold a value that is not finite"));
  }
}

TEST(Layers, CandidateIsTanhOrSigmoid) {
  LayerMaker make(1);
  EXPECT_EQ(refusal({make.lstm(3, 2, Activation::kSigmoid)}), "");
  EXPECT_TRUE(contains(refusal({make.lstm(3, 2, Activation::kRelu)}), "neither tanh nor sigmoid"));
}

}  // namespace
}  // namespace lstm_planner::test_layers
