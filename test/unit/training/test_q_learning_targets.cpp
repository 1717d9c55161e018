#include <gtest/gtest.h>

#include <vector>

#include "lstm_planner/training/q_learning_targets.hpp"

namespace lstm_planner::test_q_learning_targets {
namespace {

QTransition greedyStep(double reward, double value) {
  QTransition step;
  step.reward = reward;
  step.value = value;
  step.greedy = true;
  return step;
}

/// Two steps, and the state after them.
std::vector<QTransition> twoSteps() { return {greedyStep(1.0, 7.0), greedyStep(-0.5, 4.0), greedyStep(99.0, 6.0)}; }

TEST(QTargets, AreRewardAndDiscountedValueOfTheNextState) {
  const std::vector<double> targets = lambdaTargets(twoSteps(), 0.5, 0.0);
  ASSERT_EQ(targets.size(), 2u);
  EXPECT_DOUBLE_EQ(targets[1], -0.5 + 0.5 * 6.0);
  EXPECT_DOUBLE_EQ(targets[0], 1.0 + 0.5 * 4.0);
}

TEST(QTargets, LookFurtherByTheTraceDecay) {
  EXPECT_DOUBLE_EQ(lambdaTargets(twoSteps(), 0.5, 1.0)[0], 1.0 + 0.5 * (-0.5 + 0.5 * 6.0));
  EXPECT_DOUBLE_EQ(lambdaTargets(twoSteps(), 0.5, 0.5)[0], 1.0 + 0.5 * (0.5 * 4.0 + 0.5 * 2.5));
}

TEST(QTargets, DoNotLookPastAMoveThatWasNotTheBest) {
  std::vector<QTransition> steps = twoSteps();
  steps[1].greedy = false;
  EXPECT_DOUBLE_EQ(lambdaTargets(steps, 0.5, 1.0)[0], 1.0 + 0.5 * 4.0);
}

TEST(QTargets, ExpectNothingAfterArriving) {
  std::vector<QTransition> steps = twoSteps();
  steps[0].arrived = true;
  EXPECT_DOUBLE_EQ(lambdaTargets(steps, 0.5, 1.0)[0], 1.0);
}

TEST(QTargets, LearnNothingFromTheStepAtWhichAnEpisodeIsCutOff) {
  std::vector<QTransition> steps = twoSteps();
  steps[1].timed_out = true;
  steps[1].estimate = 3.0;
  const std::vector<double> targets = lambdaTargets(steps, 0.5, 1.0);
  EXPECT_DOUBLE_EQ(targets[1], 3.0);
  EXPECT_DOUBLE_EQ(targets[0], 1.0 + 0.5 * 4.0);
}

TEST(QTargets, HuberDerivativeIsTheErrorUpToItsLimit) {
  EXPECT_DOUBLE_EQ(huberDerivative(-1.5, 2.0), -1.5);
  EXPECT_DOUBLE_EQ(huberDerivative(7.0, 2.0), 2.0);
  EXPECT_DOUBLE_EQ(huberDerivative(-7.0, 2.0), -2.0);
}

}  // namespace
}  // namespace lstm_planner::test_q_learning_targets
