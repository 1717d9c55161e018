#include <gtest/gtest.h>

#include <numeric>

#include "lstm_planner/training/label_balance.hpp"

namespace lstm_planner::test_label_balance {
namespace {

Sequence sequenceOf(const std::vector<int>& labels) {
  const auto steps = static_cast<Eigen::Index>(labels.size());
  Sequence sequence{Eigen::MatrixXf::Zero(1, steps), Eigen::VectorXi(steps), Eigen::VectorXf::Ones(steps)};
  for (Eigen::Index i = 0; i < steps; ++i) sequence.labels[i] = labels[static_cast<std::size_t>(i)];
  return sequence;
}

double meanOverSteps(const std::vector<long>& counts, const std::vector<double>& weights) {
  double sum = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) sum += static_cast<double>(counts[i]) * weights[i];
  return sum / static_cast<double>(std::accumulate(counts.begin(), counts.end(), 0L));
}

TEST(LabelBalance, CountsOnlyStepsWithWeight) {
  Sequence sequence = sequenceOf({0, 2, 2, 1});
  sequence.weights[3] = 0.0f;
  EXPECT_EQ(countLabels({sequence, sequenceOf({2})}, 3), (std::vector<long>{1, 0, 3}));
}

TEST(LabelBalance, WeightsHaveMeanOneOverTheSteps) {
  const std::vector<long> counts = {1, 4, 100, 0, 9};
  for (const LabelBalance balance : {LabelBalance::kNone, LabelBalance::kSquareRoot, LabelBalance::kInverse}) {
    EXPECT_NEAR(meanOverSteps(counts, labelWeights(counts, balance)), 1.0, 1e-12) << static_cast<int>(balance);
  }
}

TEST(LabelBalance, WeightsFallWithTheFrequencyOrItsRoot) {
  const std::vector<long> counts = {1, 4, 100, 0};
  const std::vector<double> root = labelWeights(counts, LabelBalance::kSquareRoot);
  EXPECT_NEAR(root[0] / root[1], 2.0, 1e-12);
  EXPECT_NEAR(root[0] / root[2], 10.0, 1e-12);
  const std::vector<double> inverse = labelWeights(counts, LabelBalance::kInverse);
  EXPECT_NEAR(inverse[0] / inverse[2], 100.0, 1e-9);
  EXPECT_EQ(inverse[3], 0.0);
  EXPECT_EQ(labelWeights(counts, LabelBalance::kNone), (std::vector<double>{1.0, 1.0, 1.0, 0.0}));
}

TEST(LabelBalance, WeighingLeavesStepsWithoutWeightAlone) {
  std::vector<Sequence> sequences = {sequenceOf({0, 1, 0})};
  sequences[0].weights[2] = 0.0f;
  weigh({3.0, 0.5}, &sequences);
  EXPECT_EQ(sequences[0].weights, Eigen::Vector3f(3.0f, 0.5f, 0.0f));
}

TEST(LabelBalance, ConstantAnswerIsTheMostFrequentLabel) {
  EXPECT_DOUBLE_EQ(constantAnswerAccuracy({1, 7, 2}), 0.7);
  EXPECT_EQ(constantAnswerAccuracy({0, 0}), 0.0);
}

}  // namespace
}  // namespace lstm_planner::test_label_balance
