#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/q_learner.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_q_learner {
namespace {

QLearner learner(int units = 4) {
  const LayerStack layers = initialised(makeDenseStack(3, {units}, 2), 1);
  QLearningParameters parameters;
  parameters.target_interval = 2;
  parameters.learning_rate = 0.01;
  parameters.max_gradient_norm = 0.0;  // none
  return {parameters, 10, layers};
}

void learn(QLearner* learner) {
  learner->startUpdate();
  learner->update(Eigen::VectorXf::Ones(learner->weights().size()));
  learner->finishUpdate(5.0);
}

TEST(QLearner, TheTargetNetworkFollowsAtItsInterval) {
  QLearner it = learner();
  const Eigen::VectorXf start = it.weights();
  learn(&it);
  EXPECT_EQ(it.targetWeights(), start);
  EXPECT_NE(it.weights(), start);
  learn(&it);
  EXPECT_EQ(it.targetWeights(), start);
  const Eigen::VectorXf after_two = it.weights();
  learn(&it);
  EXPECT_EQ(it.targetWeights(), after_two);
}

TEST(QLearner, ExplorationSinksLinearlyAndStaysThere) {
  QLearner it = learner();
  EXPECT_DOUBLE_EQ(it.epsilon(), 1.0);
  learn(&it);
  EXPECT_DOUBLE_EQ(it.epsilon(), 1.0 - 0.95 / 3.0);
  for (int update = 0; update < 2; ++update) learn(&it);
  EXPECT_DOUBLE_EQ(it.epsilon(), 0.05);
  for (int update = 0; update < 5; ++update) learn(&it);
  EXPECT_DOUBLE_EQ(it.epsilon(), 0.05);
}

TEST(QLearner, GoesOnFromItsCheckpointAsIfThereHadBeenNoBreak) {
  QLearner straight = learner();
  learn(&straight);
  QLearner resumed = learner();
  resumed.restore(straight.checkpoint());
  learn(&straight);
  learn(&resumed);
  EXPECT_EQ(resumed.weights(), straight.weights());
  EXPECT_EQ(resumed.targetWeights(), straight.targetWeights());
  EXPECT_EQ(resumed.steps(), 10.0);
  EXPECT_EQ(resumed.progress(), 0.2);
}

TEST(QLearner, RefusesANetworkOfAnotherSize) {
  QLearner it = learner();
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { it.restore(learner(5).checkpoint()); }),
            "this is not a checkpoint of this training: a network of another size");
}

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

}  // namespace
}  // namespace lstm_planner::test_q_learner
