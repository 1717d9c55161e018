#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/memory_comparison.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "support/refusal.hpp"
#include "training/input_sensitivity.hpp"
#include "unit/training/gradient_fixtures.hpp"

namespace lstm_planner::test_input_sensitivity {
namespace {

/// Inputs of zero, at which tanh is the identity to first order.
std::vector<Sequence> silence(int inputs, int steps) {
  return {{Eigen::MatrixXf::Zero(inputs, steps), Eigen::VectorXi::Zero(steps), Eigen::VectorXf::Zero(steps)}};
}

TEST(FirstStepSensitivity, OfAPlainRecurrentUnitIsItsWeightToThePowerOfTheSteps) {
  const RecurrentLayer layer{Eigen::MatrixXf::Constant(1, 1, 2.0f), Eigen::MatrixXf::Constant(1, 1, -0.5f),
                             Eigen::VectorXf::Zero(1)};
  EXPECT_DOUBLE_EQ(spectralRadius(layer), 0.5);
  const Eigen::MatrixXd sensitivity = firstStepSensitivity({layer}, silence(1, 30));
  ASSERT_EQ(sensitivity.cols(), 30);
  for (int step = 0; step < 30; ++step)
    EXPECT_NEAR(sensitivity(0, step) / (2.0 * std::pow(0.5, step)), 1.0, 1e-5);  // Eq. 2.20
}

double spectralRadiusOf(const Eigen::Matrix2f& recurrent) {
  return spectralRadius({Eigen::MatrixXf::Zero(2, 1), recurrent, Eigen::VectorXf::Zero(2)});
}

TEST(SpectralRadius, IsTheLargestAbsoluteValueOfTheEigenvalues) {
  EXPECT_DOUBLE_EQ(spectralRadiusOf((Eigen::Matrix2f() << 0.25f, 0.0f, 0.0f, -2.0f).finished()), 2.0);
  // A turn: a pair of complex eigenvalues, 0.3 +- 0.4i.
  EXPECT_NEAR(spectralRadiusOf((Eigen::Matrix2f() << 0.3f, -0.4f, 0.4f, 0.3f).finished()), 0.5, 1e-7);
  // One eigenvector: |W^k| grows with k * 0.5^k.
  EXPECT_NEAR(spectralRadiusOf((Eigen::Matrix2f() << 0.5f, 1.0f, 0.0f, 0.5f).finished()), 0.5, 1e-12);
  EXPECT_EQ(spectralRadiusOf((Eigen::Matrix2f() << 0.0f, 1.0f, 0.0f, 0.0f).finished()), 0.0);  // W^2 = 0
}

/// Biases hold the gates of Figure 2.9: forget and output gate open, the input gate half open.
TEST(FirstStepSensitivity, OfAnLstmCellStaysAsLongAsTheForgetGateIsOpen) {
  LstmLayer layer{Eigen::MatrixXf::Zero(4, 1), Eigen::MatrixXf::Zero(4, 1), Eigen::VectorXf::Zero(4)};
  layer.input(3, 0) = 1.0f;
  layer.bias << 0.0f, 20.0f, 20.0f, 0.0f;
  const Eigen::MatrixXd sensitivity = firstStepSensitivity({layer}, silence(1, 100));
  EXPECT_NEAR(sensitivity(0, 0), 0.5, 1e-6);
  EXPECT_NEAR(sensitivity(0, 99), 0.5, 1e-6);
  layer.bias[2] = 0.0f;  // half open
  EXPECT_NEAR(firstStepSensitivity({layer}, silence(1, 30))(0, 29) / (0.5 * std::pow(0.5, 29)), 1.0, 1e-5);
}

/// By central differences of the equations, for several units, inputs and sequences.
Eigen::MatrixXd expectedSensitivity(const LayerStack& first, const std::vector<Sequence>& sequences) {
  const Eigen::VectorXd parameters = parameterVector(first).cast<double>();
  const Eigen::Index steps = sequences.front().steps();
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(outputSize(first), steps);
  for (const Sequence& sequence : sequences) {
    const Eigen::MatrixXd inputs = sequence.inputs.cast<double>();
    for (int unit = 0; unit < squares.rows(); ++unit) {
      for (int last = 0; last < steps; ++last) {
        const auto outputOf = [&](const Eigen::VectorXd& first_inputs) {
          test::ReferenceNetwork network(first, parameters);
          double output = network.forward(first_inputs)[unit];
          for (int step = 1; step <= last; ++step) output = network.forward(inputs.col(step))[unit];
          return output;
        };
        squares(unit, last) += centralDifferences(inputs.col(0), outputOf).squaredNorm();
      }
    }
  }
  return (squares / static_cast<double>(sequences.size())).cwiseSqrt();
}

TEST(FirstStepSensitivity, IsTheDerivativeOfTheEquations) {
  constexpr int kUnits = 2;
  const std::vector<Sequence> sequences = recallSequences(2, 4, 1);
  const int inputs = static_cast<int>(sequences.front().inputs.rows());
  const LayerStack lstm = {makeLstmStack(inputs, {kUnits}, 2).front()};
  LayerStack sigmoid = lstm;
  std::get<LstmLayer>(sigmoid.front()).candidate = Activation::kSigmoid;
  const LayerStack plain = {RecurrentLayer{Eigen::MatrixXf::Zero(kUnits, inputs), Eigen::MatrixXf::Zero(kUnits, kUnits),
                                           Eigen::VectorXf::Zero(kUnits)}};
  for (const LayerStack& first : {initialised(lstm, 3), initialised(sigmoid, 4), initialised(plain, 5)}) {
    const Eigen::MatrixXd expected = expectedSensitivity(first, sequences);
    EXPECT_LT((firstStepSensitivity(first, sequences) - expected).norm(), 1e-6 * expected.norm());
  }
}

TEST(FirstStepSensitivity, IsExactWhereSinglePrecisionEnds) {
  const RecurrentLayer layer{Eigen::MatrixXf::Ones(1, 1), Eigen::MatrixXf::Constant(1, 1, 0.25f),
                             Eigen::VectorXf::Zero(1)};
  EXPECT_NEAR(firstStepSensitivity({layer}, silence(1, 101))(0, 100) / std::pow(0.25, 100), 1.0, 1e-9);  // 6e-61
}

TEST(FirstStepSensitivity, RefusesWhatHasNone) {
  const auto refusal = [](const LayerStack& layers, const std::vector<Sequence>& sequences) {
    return test::refusalOf<std::invalid_argument>([&] { firstStepSensitivity(layers, sequences); });
  };
  const LayerStack lstm = makeLstmStack(3, {4}, 2);
  EXPECT_EQ(refusal(makeDenseStack(3, {4}, 2), recallSequences(2, 3, 1)),
            "the first layer is not recurrent, expected LSTM or plain recurrent");
  EXPECT_EQ(refusal(lstm, {}), "there are no sequences, expected at least one");
  std::vector<Sequence> ragged = recallSequences(1, 3, 1);
  ragged.push_back(recallSequences(1, 4, 1).front());
  EXPECT_EQ(refusal(lstm, ragged), "the sequences differ in length, expected one length");
}

}  // namespace
}  // namespace lstm_planner::test_input_sensitivity
