#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "lstm_planner/common/random.hpp"
#include "lstm_planner/network/network.hpp"
#include "lstm_planner/training/gradient.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/parameter_vector.hpp"

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
    parameters.distribution = WeightDistribution::kUniform;
    parameters.range = 0.8;
    initialise(parameters, 17, stack.layers);
    // Biases too, which initialise() leaves at zero.
    Eigen::VectorXf weights = parameterVector(stack.layers);
    Random random(5);
    for (Eigen::Index index = 0; index < weights.size(); ++index) {
      weights[index] += static_cast<float>(uniform(random, -0.2, 0.2));
    }
    setParameterVector(weights, stack.layers);
  }
  return stacks;
}

/// Holds the gradient to central differences of the loss.
void expectDifferences(Eigen::VectorXd parameters, const std::vector<const Sequence*>& batch,
                       SequenceGradient<double>* computer) {
  Eigen::VectorXd gradient;
  computer->lossAndGradient(parameters, batch, gradient);
  ASSERT_EQ(gradient.size(), parameters.size());
  // Truncation grows with step^2 (1e-10), rounding with 1e-16 * loss / step (1e-10 for a loss of some tens).
  const double kStep = 1e-5;
  for (Eigen::Index index = 0; index < parameters.size(); ++index) {
    const double kept = parameters[index];
    parameters[index] = kept + kStep;
    const double above = computer->loss(parameters, batch).loss;
    parameters[index] = kept - kStep;
    const double below = computer->loss(parameters, batch).loss;
    parameters[index] = kept;
    const double difference = (above - below) / (2.0 * kStep);
    EXPECT_NEAR(gradient[index], difference, 1e-6 * std::abs(difference) + 2e-9) << "parameter " << index;
  }
  // A gradient of zeros would agree with a loss that looks at nothing.
  EXPECT_GT(gradient.norm(), 0.1);
}

TEST(SequenceGradient, AgreesWithCentralFiniteDifferencesForEachKindOfLayer) {
  const std::vector<Sequence> sequences = raggedSequences();
  const auto batch = pointersTo(sequences);
  for (const NamedStack& stack : stacksOfEachKind()) {
    SCOPED_TRACE(stack.name);
    SequenceGradient<double> computer(stack.layers);
    expectDifferences(parameterVector(stack.layers).cast<double>(), batch, &computer);
  }
}

TEST(SequenceGradient, TheEuclideanLossAgreesWithFiniteDifferencesToo) {
  const std::vector<Sequence> sequences = raggedSequences();
  for (const NamedStack& stack : stacksOfEachKind()) {
    if (std::holds_alternative<SoftmaxLayer>(stack.layers.back())) continue;  // refused
    SCOPED_TRACE(stack.name);
    SequenceGradient<double> computer(stack.layers, Loss::kEuclidean);
    expectDifferences(parameterVector(stack.layers).cast<double>(), pointersTo(sequences), &computer);
  }
}

/// Thesis Eq. 2.6 and 2.7, by hand: y = (0.5, -0.25), label 1.
TEST(SequenceGradient, TheEuclideanLossIsHalfTheSquaredDistanceToTheTarget) {
  DenseLayer layer{Eigen::MatrixXf::Zero(2, 1), Eigen::VectorXf::Zero(2), Activation::kIdentity};
  layer.weights << 0.25f, -0.125f;
  const Sequence sequence{Eigen::MatrixXf::Constant(1, 1, 2.0f), Eigen::VectorXi::Constant(1, 1),
                          Eigen::VectorXf::Constant(1, 3.0f)};
  SequenceGradient<double> computer({layer}, Loss::kEuclidean);
  Eigen::VectorXd gradient;
  const LossSum sum = computer.lossAndGradient(parameterVector({layer}).cast<double>(), {&sequence}, gradient);
  EXPECT_DOUBLE_EQ(sum.loss, 3.0 * 0.5 * (0.5 * 0.5 + 1.25 * 1.25));
  EXPECT_EQ(sum.weight, 3.0);
  EXPECT_EQ(sum.confusion(1, 0), 1);  // the answer is the higher preference
  const Eigen::Vector4d expected(3.0 * 0.5 * 2.0, 3.0 * -1.25 * 2.0, 3.0 * 0.5, 3.0 * -1.25);
  EXPECT_LT((gradient - expected).norm(), 1e-12) << gradient.transpose();
}

TEST(SequenceGradient, ForwardPassAgreesWithTheNetworkThatDrives) {
  for (const NamedStack& stack : stacksOfEachKind()) {
    if (std::holds_alternative<SoftmaxLayer>(stack.layers.back())) continue;  // preferences come before the softmax
    SCOPED_TRACE(stack.name);
    Random random(8);
    const Sequence sequence = randomSequence(50, random);
    SequenceGradient<float> computer(stack.layers);
    const Eigen::MatrixXf preferences = computer.preferences(parameterVector(stack.layers), sequence);
    Network network(stack.layers);
    for (int step = 0; step < sequence.steps(); ++step) {
      const Eigen::VectorXf& expected = network.forward(sequence.inputs.col(step));
      // Single precision with tanh to a few units in the last place, fed back over 50 steps.
      ASSERT_LT((preferences.col(step) - expected).cwiseAbs().maxCoeff(), 1e-5f) << "step " << step;
    }
  }
}

TEST(SequenceGradient, SoftmaxLayerIsTheOneOfTheLoss) {
  LayerStack layers = makeLstmStack(kInputs, {4}, kOutputs);
  initialise({}, 2, layers);
  const Eigen::VectorXd parameters = parameterVector(layers).cast<double>();
  const std::vector<Sequence> sequences = raggedSequences();
  const double without = SequenceGradient<double>(layers).loss(parameters, pointersTo(sequences)).loss;
  layers.push_back(SoftmaxLayer{});
  EXPECT_EQ(SequenceGradient<double>(layers).loss(parameters, pointersTo(sequences)).loss, without);
}

TEST(SequenceGradient, BatchIsTheSumOfItsSequences) {
  LayerStack layers = makeLstmStack(kInputs, {4, 4}, kOutputs);
  initialise({}, 9, layers);
  const Eigen::VectorXd parameters = parameterVector(layers).cast<double>();
  const std::vector<Sequence> sequences = raggedSequences();
  SequenceGradient<double> computer(layers);
  Eigen::VectorXd together;
  const LossSum whole = computer.lossAndGradient(parameters, pointersTo(sequences), together);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(parameters.size());
  LossSum parts;
  for (const Sequence& sequence : sequences) {
    Eigen::VectorXd gradient;
    parts += computer.lossAndGradient(parameters, {&sequence}, gradient);
    sum += gradient;
  }
  EXPECT_NEAR(whole.loss, parts.loss, 1e-12 * whole.loss);
  EXPECT_EQ(whole.confusion, parts.confusion);
  EXPECT_EQ(whole.confusion.sum(), 4 + 7 + 1 + 7 + 5 - 2);  // all steps but the two without a weight
  EXPECT_LT((together - sum).norm(), 1e-12 * sum.norm());
}

TEST(SequenceGradient, EqualPreferencesLoseTheLogarithmOfTheNumberOfClasses) {
  const LayerStack layers = makeDenseStack(kInputs, {}, kOutputs);
  Random random(1);
  const Sequence sequence = randomSequence(9, random);
  const Eigen::VectorXd zeros = parameterVector(layers).cast<double>();
  EXPECT_NEAR(SequenceGradient<double>(layers).loss(zeros, {&sequence}).meanLoss(), std::log(double{kOutputs}), 1e-12);
}

TEST(SequenceGradient, HugePreferencesStayFinite) {
  LayerStack layers = makeDenseStack(kInputs, {}, kOutputs);
  initialise({}, 1, layers);
  const Eigen::VectorXf parameters = 1e6f * parameterVector(layers);
  Random random(1);
  const Sequence sequence = randomSequence(9, random);
  Eigen::VectorXf gradient;
  EXPECT_TRUE(std::isfinite(SequenceGradient<float>(layers).lossAndGradient(parameters, {&sequence}, gradient).loss));
  EXPECT_TRUE(gradient.allFinite());
}

TEST(SequenceGradient, EmptyBatchHasNoLossAndNoGradient) {
  LayerStack layers = makeLstmStack(kInputs, {4}, kOutputs);
  SequenceGradient<float> computer(layers);
  Eigen::VectorXf gradient;
  EXPECT_EQ(computer.lossAndGradient(parameterVector(layers), {}, gradient).weight, 0.0);
  EXPECT_TRUE((gradient.array() == 0.0f).all());
}

TEST(SequenceGradient, RefusesWhatItCannotTrain) {
  LayerStack softmax_inside = makeDenseStack(kInputs, {4}, kOutputs);
  softmax_inside.insert(softmax_inside.begin() + 1, SoftmaxLayer{});
  EXPECT_THROW(SequenceGradient<float>{softmax_inside}, std::invalid_argument);
  EXPECT_THROW(SequenceGradient<float>{LayerStack{}}, std::invalid_argument);
  const LayerStack softmax_last = {makeDenseStack(kInputs, {}, kOutputs)[0], SoftmaxLayer{}};
  EXPECT_NO_THROW(SequenceGradient<float>{softmax_last});
  EXPECT_THROW(SequenceGradient<float>(softmax_last, Loss::kEuclidean), std::invalid_argument);
  const LayerStack layers = makeDenseStack(kInputs, {4}, kOutputs);
  Random random(1);
  const Sequence sequence = randomSequence(2, random);
  EXPECT_THROW(SequenceGradient<float>(layers).loss(Eigen::VectorXf::Zero(3), {&sequence}), std::invalid_argument);
}

TEST(ParameterVector, RoundTripKeepsEveryParameterAndTellsWeightsFromBiases) {
  LayerStack layers = makeLstmStack(11, {8, 8}, 8);
  initialise({}, 4, layers);
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
