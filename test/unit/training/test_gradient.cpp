#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/network/network.hpp"
#include "lstm_planner/training/gradient.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/lane_network.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "support/refusal.hpp"
#include "training/lane_kernels.hpp"
#include "unit/training/gradient_fixtures.hpp"

namespace lstm_planner::test_gradient {
namespace {

constexpr int kInputs = 3;
constexpr int kOutputs = 4;

Sequence randomSequence(int steps, Random& random) {
  Sequence sequence{Eigen::MatrixXf(kInputs, steps), Eigen::VectorXi(steps), Eigen::VectorXf(steps)};
  for (int step = 0; step < steps; ++step) {
    for (int input = 0; input < kInputs; ++input) sequence.inputs(input, step) = static_cast<float>(normal(random));
    sequence.labels[step] = static_cast<int>(uniformIndex(random, kOutputs));
    sequence.weights[step] = static_cast<float>(uniform(random, 0.5, 2.0));
  }
  return sequence;
}

/// Different lengths in an order that must be sorted, equal lengths, a single step, and steps that do not count.
std::vector<Sequence> raggedSequences() {
  Random random(3);
  std::vector<Sequence> sequences;
  for (const int steps : {4, 7, 1, 7, 5}) sequences.push_back(randomSequence(steps, random));
  sequences[1].weights[2] = 0.0f;
  sequences[1].labels[2] = -1;
  sequences[0].weights[3] = 0.0f;
  return sequences;
}

std::vector<const Sequence*> pointersTo(const std::vector<Sequence>& sequences) {
  std::vector<const Sequence*> pointers;
  for (const Sequence& sequence : sequences) pointers.push_back(&sequence);
  return pointers;
}

RecurrentLayer plainRecurrentLayer(int inputs, int units) {
  return {Eigen::MatrixXf::Zero(units, inputs), Eigen::MatrixXf::Zero(units, units), Eigen::VectorXf::Zero(units)};
}

DenseLayer denseLayer(int inputs, int units, Activation activation) {
  return {Eigen::MatrixXf::Zero(units, inputs), Eigen::VectorXf::Zero(units), activation};
}

/// One stack for each kind of layer, with a second layer of that kind so that errors also pass through it.
struct NamedStack {
  const char* name;
  LayerStack layers;
};

std::vector<NamedStack> stacksOfEachKind() {
  const auto dense = [](Activation activation) {
    return LayerStack{denseLayer(kInputs, 6, activation), denseLayer(6, 5, activation),
                      denseLayer(5, kOutputs, Activation::kIdentity)};
  };
  LayerStack with_softmax = makeLstmStack(kInputs, {4}, kOutputs);
  with_softmax.push_back(SoftmaxLayer{});
  std::vector<NamedStack> stacks = {
      {"lstm tanh", makeLstmStack(kInputs, {4, 3}, kOutputs, Activation::kTanh)},
      {"lstm sigmoid", makeLstmStack(kInputs, {4, 3}, kOutputs, Activation::kSigmoid)},
      {"lstm as output", LayerStack{makeLstmStack(kInputs, {kOutputs}, 1)[0]}},
      {"recurrent",
       {plainRecurrentLayer(kInputs, 5), plainRecurrentLayer(5, 3), denseLayer(3, kOutputs, Activation::kIdentity)}},
      {"dense identity", dense(Activation::kIdentity)},
      {"dense tanh", dense(Activation::kTanh)},
      {"dense sigmoid", dense(Activation::kSigmoid)},
      {"dense relu", dense(Activation::kRelu)},
      {"activated output", {denseLayer(kInputs, kOutputs, Activation::kTanh)}},
      {"softmax", with_softmax},
  };
  for (NamedStack& stack : stacks) {
    InitialisationParameters parameters;
    parameters.range = 0.8;
    stack.layers = initialised(stack.layers, 17, parameters);
    // Biases too, which initialised() leaves at zero.
    Eigen::VectorXf weights = parameterVector(stack.layers);
    Random random(5);
    for (Eigen::Index index = 0; index < weights.size(); ++index) {
      weights[index] += static_cast<float>(uniform(random, -0.2, 0.2));
    }
    setParameterVector(weights, stack.layers);
  }
  return stacks;
}

/// Loss and gradient are those of the equations in double precision, but for the rounding of single precision.
void expectEquations(const LayerStack& layers, Loss loss) {
  const std::vector<Sequence> sequences = raggedSequences();
  const auto batch = pointersTo(sequences);
  const Eigen::VectorXf parameters = parameterVector(layers);
  Eigen::VectorXf gradient;
  const LossSum sum = SequenceGradient(layers, loss).loss(parameters, batch, &gradient);
  const auto lossAt = [&](const Eigen::VectorXd& place) { return doubleLoss(layers, place, batch, loss); };
  EXPECT_NEAR(sum.loss, lossAt(parameters.cast<double>()), 1e-5 * sum.loss);
  const Eigen::VectorXd expected = centralDifferences(parameters.cast<double>(), lossAt);
  EXPECT_LT((gradient.cast<double>() - expected).norm(), 1e-5 * expected.norm());
  // A gradient of zeros would agree with a loss that looks at nothing.
  EXPECT_GT(gradient.norm(), 0.1f);
}

TEST(SequenceGradient, AgreesWithCentralFiniteDifferencesForEachKindOfLayer) {
  for (const NamedStack& stack : stacksOfEachKind()) {
    SCOPED_TRACE(stack.name);
    expectEquations(stack.layers, Loss::kCrossEntropy);
  }
}

TEST(SequenceGradient, TheEuclideanLossAgreesWithFiniteDifferencesToo) {
  for (const NamedStack& stack : stacksOfEachKind()) {
    if (std::holds_alternative<SoftmaxLayer>(stack.layers.back())) continue;  // refused
    SCOPED_TRACE(stack.name);
    expectEquations(stack.layers, Loss::kEuclidean);
  }
}

/// Thesis Eq. 2.6 and 2.7, by hand: y = (0.5, -0.25), label 1.
TEST(SequenceGradient, TheEuclideanLossIsHalfTheSquaredDistanceToTheTarget) {
  DenseLayer layer{Eigen::MatrixXf::Zero(2, 1), Eigen::VectorXf::Zero(2), Activation::kIdentity};
  layer.weights << 0.25f, -0.125f;
  const Sequence sequence{Eigen::MatrixXf::Constant(1, 1, 2.0f), Eigen::VectorXi::Constant(1, 1),
                          Eigen::VectorXf::Constant(1, 3.0f)};
  SequenceGradient computer({layer}, Loss::kEuclidean);
  Eigen::VectorXf gradient;
  const LossSum sum = computer.loss(parameterVector({layer}), {&sequence}, &gradient);
  EXPECT_DOUBLE_EQ(sum.loss, 3.0 * 0.5 * (0.5 * 0.5 + 1.25 * 1.25));
  EXPECT_EQ(sum.weight, 3.0);
  EXPECT_EQ(sum.confusion(1, 0), 1);  // the answer is the higher preference
  EXPECT_EQ(gradient, Eigen::Vector4f(3.0f * 0.5f * 2.0f, 3.0f * -1.25f * 2.0f, 3.0f * 0.5f, 3.0f * -1.25f));
}

TEST(LaneNetwork, ForwardPassOfEachKindAgreesWithTheNetworkThatDrives) {
  for (const NamedStack& stack : stacksOfEachKind()) {
    if (std::holds_alternative<SoftmaxLayer>(stack.layers.back())) continue;  // the lanes have none
    SCOPED_TRACE(stack.name);
    Random random(8);
    const Sequence sequence = randomSequence(50, random);
    const Eigen::VectorXf parameters = parameterVector(stack.layers);
    LaneNetwork lanes(stack.layers, kLaneGroup, static_cast<int>(sequence.steps()));
    Network network(stack.layers);
    for (int step = 0; step < sequence.steps(); ++step) {
      for (int i = 0; i < kInputs; ++i) {
        std::fill_n(lanes.inputs(step) + i * kLaneGroup, kLaneGroup, sequence.inputs(i, step));
      }
      const float* found = lanes.forward(parameters, step);
      const Eigen::VectorXf& expected = network.forward(sequence.inputs.col(step));
      // Single precision with tanh to a few units in the last place, fed back over 50 steps.
      for (int i = 0; i < expected.size(); ++i)
        ASSERT_NEAR(found[i * kLaneGroup], expected[i], 1e-5f) << "step " << step;
    }
  }
}

TEST(SequenceGradient, SoftmaxLayerIsTheOneOfTheLoss) {
  LayerStack layers = initialised(makeLstmStack(kInputs, {4}, kOutputs), 2);
  const Eigen::VectorXf parameters = parameterVector(layers);
  const std::vector<Sequence> sequences = raggedSequences();
  const double without = SequenceGradient(layers).loss(parameters, pointersTo(sequences)).loss;
  layers.push_back(SoftmaxLayer{});
  EXPECT_EQ(SequenceGradient(layers).loss(parameters, pointersTo(sequences)).loss, without);
}

/// More than are computed together, of different lengths.
void expectThatTheBatchIsTheSum(const LayerStack& zeros) {
  const LayerStack layers = initialised(zeros, 9);
  const Eigen::VectorXf parameters = parameterVector(layers);
  std::vector<Sequence> sequences;
  for (int i = 0; i < 4; ++i) {
    for (const Sequence& sequence : raggedSequences()) sequences.push_back(sequence);
  }
  SequenceGradient computer(layers);
  Eigen::VectorXf together;
  const LossSum whole = computer.loss(parameters, pointersTo(sequences), &together);
  Eigen::VectorXf sum = Eigen::VectorXf::Zero(parameters.size());
  LossSum parts;
  for (const Sequence& sequence : sequences) {
    Eigen::VectorXf gradient;
    parts += computer.loss(parameters, {&sequence}, &gradient);
    sum += gradient;
  }
  EXPECT_NEAR(whole.loss, parts.loss, 1e-12 * whole.loss);  // each lane is computed as if it were alone
  EXPECT_EQ(whole.confusion, parts.confusion);
  EXPECT_EQ(whole.confusion.sum(), 4 * (4 + 7 + 1 + 7 + 5 - 2));  // all steps but the two without a weight
  EXPECT_LT((together - sum).norm(), 1e-6f * sum.norm());
}

TEST(SequenceGradient, BatchIsTheSumOfItsSequences) {
  expectThatTheBatchIsTheSum(makeLstmStack(kInputs, {4, 4}, kOutputs));
  expectThatTheBatchIsTheSum(makeDenseStack(kInputs, {4}, kOutputs));  // without memory a sequence is cut
}

TEST(SequenceGradient, EqualPreferencesLoseTheLogarithmOfTheNumberOfClasses) {
  const LayerStack layers = makeDenseStack(kInputs, {}, kOutputs);
  Random random(1);
  const Sequence sequence = randomSequence(9, random);
  EXPECT_NEAR(SequenceGradient(layers).loss(parameterVector(layers), {&sequence}).meanLoss(),
              std::log(double{kOutputs}), 1e-6);
}

TEST(SequenceGradient, HugePreferencesStayFinite) {
  const LayerStack layers = initialised(makeDenseStack(kInputs, {}, kOutputs), 1);
  const Eigen::VectorXf parameters = 1e6f * parameterVector(layers);
  Random random(1);
  const Sequence sequence = randomSequence(9, random);
  Eigen::VectorXf gradient;
  EXPECT_TRUE(std::isfinite(SequenceGradient(layers).loss(parameters, {&sequence}, &gradient).loss));
  EXPECT_TRUE(gradient.allFinite());
}

TEST(SequenceGradient, EmptyBatchHasNoLossAndNoGradient) {
  LayerStack layers = makeLstmStack(kInputs, {4}, kOutputs);
  SequenceGradient computer(layers);
  Eigen::VectorXf gradient;
  EXPECT_EQ(computer.loss(parameterVector(layers), {}, &gradient).weight, 0.0);
  EXPECT_TRUE((gradient.array() == 0.0f).all());
}

TEST(SequenceGradient, RefusesWhatItCannotTrain) {
  LayerStack softmax_inside = makeDenseStack(kInputs, {4}, kOutputs);
  softmax_inside.insert(softmax_inside.begin() + 1, SoftmaxLayer{});
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { SequenceGradient{softmax_inside}; }),
            "a softmax can only be trained as the last of several layers, with the cross-entropy");
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([] { SequenceGradient{LayerStack{}}; }),
            "the network has no layers, expected at least one");
  const LayerStack softmax_last = {makeDenseStack(kInputs, {}, kOutputs)[0], SoftmaxLayer{}};
  EXPECT_NO_THROW(SequenceGradient{softmax_last});
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { SequenceGradient(softmax_last, Loss::kEuclidean); }),
            "the last layer is a softmax, which cannot be trained with the Euclidean loss");
  const LayerStack layers = makeDenseStack(kInputs, {4}, kOutputs);
  Random random(1);
  const Sequence sequence = randomSequence(2, random);
  EXPECT_EQ(test::refusalOf<std::invalid_argument>(
                [&] { SequenceGradient(layers).loss(Eigen::VectorXf::Zero(3), {&sequence}); }),
            "parameter vector has 3 values, the layers expect 36");
}

TEST(ParameterVector, RoundTripKeepsEveryParameterAndTellsWeightsFromBiases) {
  const LayerStack layers = initialised(makeLstmStack(11, {8, 8}, 8), 4);
  const Eigen::VectorXf parameters = parameterVector(layers);
  ASSERT_EQ(static_cast<std::size_t>(parameters.size()), countWeights(layers));
  LayerStack copy = makeLstmStack(11, {8, 8}, 8);
  setParameterVector(parameters, copy);
  EXPECT_EQ(parameterVector(copy), parameters);
  EXPECT_EQ(static_cast<float>(parameters.size()) - weightMask(layers).sum(), 32 + 32 + 8);  // the biases
  EXPECT_THROW(setParameterVector(parameters.head(7), copy), std::invalid_argument);
}

}  // namespace
}  // namespace lstm_planner::test_gradient
