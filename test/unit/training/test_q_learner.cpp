#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/q_learner.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_q_learner {
namespace {

QLearner learner(int units = 4, double exploration_share = 0.5) {
  const LayerStack layers = initialised(makeDenseStack(3, {units}, 2), 1);
  QLearningParameters parameters;
  parameters.target_interval = 2;
  parameters.exploration_end = 0.2;
  parameters.exploration_share = exploration_share;
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
  for (int update = 0; update < 2; ++update) learn(&it);
  EXPECT_DOUBLE_EQ(it.epsilon(), 0.68);
  for (int update = 0; update < 5; ++update) learn(&it);
  EXPECT_DOUBLE_EQ(it.epsilon(), 0.2);
  EXPECT_DOUBLE_EQ(learner(4, 0.0).epsilon(), 0.2);
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

}  // namespace
}  // namespace lstm_planner::test_q_learner
