#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "lstm_planner/training/actor_critic.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/q_learner.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_actor_critic {
namespace {

LayerStack network(int outputs, std::uint64_t seed) { return initialised(makeDenseStack(3, {4}, outputs), seed); }

ActorCritic learner(std::size_t sets = 2) {
  ActorCriticParameters parameters;
  parameters.entropy_start = 0.3;
  parameters.entropy_end = 0.1;
  parameters.learning_rate = 0.01;
  parameters.critic_learning_rate = 0.02;
  parameters.max_gradient_norm = 0.0;  // none
  return {parameters, 4, network(2, 1), network(1, 2), sets};
}

void learn(ActorCritic* learner) {
  learner->updatePolicy(Eigen::VectorXf::Ones(learner->policy().size()), 7.0);
  learner->updateCritic(Eigen::VectorXf::Ones(learner->critic().size()), 7.0);
  learner->advantageVariances()[1] *= 0.5;
  learner->finishUpdate(7.0);
}

TEST(Advantages, AreTheDiscountedSumOfTheErrorsToCome) {
  constexpr double kDiscount = 0.9;
  constexpr double kDecay = 0.8;
  const double rewards[] = {1.0, -2.0, 3.0};
  const double values[] = {0.5, 0.25, -1.0, 0.0};  // nothing after the arrival
  Advantages advantages(kDiscount, kDecay);
  for (int step = 2; step >= 0; --step) {
    double expected = 0.0;  // Eq. 16 of the paper
    for (int later = step; later < 3; ++later) {
      const double error = rewards[later] + kDiscount * values[later + 1] - values[later];
      expected += std::pow(kDiscount * kDecay, later - step) * error;
    }
    const auto end = step == 2 ? Advantages::End::kArrived : Advantages::End::kNone;
    EXPECT_NEAR(advantages.before(rewards[step], values[step], end), expected, 1e-12) << step;
  }
}

TEST(Advantages, NothingComesAfterAnArrivalAndTheSameAfterACut) {
  Advantages advantages(0.9, 0.8);
  EXPECT_DOUBLE_EQ(advantages.before(2.0, 0.5, Advantages::End::kArrived), 2.0 - 0.5);
  EXPECT_DOUBLE_EQ(advantages.before(2.0, 0.5, Advantages::End::kCutOff), 2.0 + 0.9 * 0.5 - 0.5);
}

TEST(CriticSums, AllOfTheVarianceIsExplainedWhereThereAreNoErrorsAndNoneWhereTheMeanIsAsGood) {
  CriticSums knows(1);
  CriticSums guesses(1);
  for (const double result : {1.0, 2.0, 6.0}) {
    knows.count(0, result, 0.0);
    guesses.count(0, 3.0, result - 3.0);
  }
  EXPECT_DOUBLE_EQ(knows.explained(), 1.0);
  EXPECT_NEAR(guesses.explained(), 0.0, 1e-12);
}

TEST(CriticSums, VariancesMoveTowardsThoseOfTheSetsThatWereSeen) {
  CriticSums sums(2);
  sums.count(1, 0.0, 1.0);
  sums.count(1, 0.0, -3.0);
  std::vector<double> variances = {4.0, 1.0};
  sums.moveVariances(0.5, &variances);
  EXPECT_DOUBLE_EQ(variances[0], 4.0);  // nothing was seen of it
  EXPECT_DOUBLE_EQ(variances[1], 1.0 + 0.5 * ((1.0 + 9.0) / 2.0 - 1.0));
}

TEST(CriticSums, SumsOfPartsAreThoseOfTheWhole) {
  CriticSums whole(2), first(2), second(2);
  for (CriticSums* sums : {&whole, &first}) sums->count(0, 1.0, 2.0);
  for (CriticSums* sums : {&whole, &second}) sums->count(1, -1.0, 4.0);
  first += second;
  EXPECT_EQ(first.steps, whole.steps);
  EXPECT_DOUBLE_EQ(first.explained(), whole.explained());
  EXPECT_EQ(first.set_steps, whole.set_steps);
  EXPECT_EQ(first.set_squared_advantages, whole.set_squared_advantages);
}

TEST(ActorCritic, TheEntropyWeightSinksFromStartToEnd) {
  ActorCritic it = learner();
  EXPECT_DOUBLE_EQ(it.entropyWeight(), 0.3);
  for (int update = 0; update < 2; ++update) learn(&it);
  EXPECT_DOUBLE_EQ(it.entropyWeight(), 0.2);
  for (int update = 0; update < 2; ++update) learn(&it);
  EXPECT_DOUBLE_EQ(it.entropyWeight(), 0.1);
}

TEST(ActorCritic, NothingMovesAfterTheLastUpdate) {
  ActorCritic it = learner();
  for (int update = 0; update < 4; ++update) learn(&it);
  const Eigen::VectorXf policy = it.policy();
  learn(&it);
  EXPECT_EQ(it.policy(), policy);
}

TEST(ActorCritic, GoesOnFromItsCheckpointAsIfThereHadBeenNoBreak) {
  ActorCritic straight = learner();
  learn(&straight);
  ActorCritic resumed = learner();
  resumed.restore(straight.checkpoint());
  learn(&straight);
  learn(&resumed);
  EXPECT_EQ(resumed.policy(), straight.policy());
  EXPECT_EQ(resumed.critic(), straight.critic());
  EXPECT_EQ(resumed.advantageVariances(), straight.advantageVariances());
  EXPECT_EQ(resumed.steps(), 14.0);
  EXPECT_EQ(resumed.updates(), 2);
}

TEST(ActorCritic, RefusesOtherCheckpointsAndStaysAsItWas) {
  ActorCritic it = learner();
  const Eigen::VectorXf policy = it.policy();
  const auto refusal = [&](const std::vector<std::uint8_t>& checkpoint) {
    return test::refusalOf<std::invalid_argument>([&] { it.restore(checkpoint); });
  };
  const std::string start = "this is not a checkpoint of this training: ";
  EXPECT_EQ(refusal(QLearner({}, 4, network(2, 1)).checkpoint()), start + "another format");
  EXPECT_EQ(refusal(learner(3).checkpoint()), start + "another number of kinds of maps or worlds");
  EXPECT_EQ(refusal({}).find(start), 0u);
  EXPECT_EQ(it.policy(), policy);
}

}  // namespace
}  // namespace lstm_planner::test_actor_critic
