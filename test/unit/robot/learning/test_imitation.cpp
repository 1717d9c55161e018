#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "lstm_planner/base/learning/confusion.hpp"
#include "lstm_planner/base/learning/parameter_vector.hpp"
#include "lstm_planner/robot/learning/imitation.hpp"
#include "support/refusal.hpp"

namespace lstm_planner {
namespace {

ImitationParameters tinyImitation(int threads) {
  ImitationParameters parameters;
  parameters.shape.cells = {4};
  parameters.rounds = 2;
  parameters.worlds = 3;
  parameters.goals = 1;
  parameters.starts = 1;
  parameters.validation_worlds = 2;
  parameters.max_steps = 40;
  parameters.threads = threads;
  parameters.trainer.epochs = 2;
  parameters.trainer.threads = threads;
  return parameters;
}

TEST(Imitation, GivesTheSameWeightsForAnyNumberOfThreads) {
  std::vector<double> progress;
  const ImitationResult one = imitate(tinyImitation(1), [&](double share) { progress.push_back(share); });
  const ImitationResult two = imitate(tinyImitation(2));
  const Eigen::VectorXf weights = parameterVector(one.layers);
  EXPECT_GT(weights.size(), 0);
  EXPECT_EQ(weights, parameterVector(two.layers));

  ASSERT_EQ(one.rounds.size(), 2u);
  for (std::size_t round = 0; round < 2; ++round) {
    EXPECT_EQ(one.rounds[round].round, static_cast<int>(round) + 1);
    EXPECT_EQ(one.rounds[round].steps, two.rounds[round].steps);
    EXPECT_EQ(one.rounds[round].score.arrival, two.rounds[round].score.arrival);
  }
  EXPECT_GT(one.rounds[1].steps, one.rounds[0].steps);  // everything collected before is kept

  ASSERT_FALSE(progress.empty());
  for (std::size_t i = 1; i < progress.size(); ++i) EXPECT_GT(progress[i], progress[i - 1]);
  EXPECT_DOUBLE_EQ(progress.back(), 1.0);
}

TEST(Imitation, LearnsWhatTheTeacherDoesAtEachLabel) {
  ImitationParameters parameters = tinyImitation(2);
  parameters.course.worlds = {WorldKind::kMaze};
  parameters.shape.cells = {8};
  parameters.rounds = 1;
  parameters.worlds = 20;
  parameters.starts = 2;
  parameters.max_steps = 100;
  parameters.trainer.epochs = 40;
  parameters.trainer.batch_size = 4;
  parameters.trainer.optimiser.learning_rate = 0.02;
  const std::vector<EpochReport> curve = imitate(parameters).rounds.at(0).training.curve;
  // Always the same one of five answers is worth 20 %, though the most frequent label alone is worth 61 % unbalanced.
  EXPECT_LT(balancedAccuracy(curve.front().training.confusion), 0.3);
  EXPECT_GT(balancedAccuracy(curve.back().training.confusion), 0.5);
}

TEST(Imitation, RefusesParametersWithWhichNothingIsLearned) {
  const auto refused = [](void (*change)(ImitationParameters*)) { return test::isRefused(tinyImitation(1), change); };
  EXPECT_FALSE(refused([](ImitationParameters*) {}));
  EXPECT_TRUE(refused([](ImitationParameters* p) { p->rounds = 0; }));
  EXPECT_TRUE(refused([](ImitationParameters* p) { p->worlds = 0; }));
  EXPECT_TRUE(refused([](ImitationParameters* p) { p->validation_worlds = 0; }));
  EXPECT_TRUE(refused([](ImitationParameters* p) { p->learner_share = 1.1; }));
  EXPECT_TRUE(refused([](ImitationParameters* p) { p->sequence_steps = p->burn_in_steps; }));
  EXPECT_TRUE(refused([](ImitationParameters* p) { p->threads = 0; }));
  EXPECT_TRUE(refused([](ImitationParameters* p) { p->trainer.epochs = 0; }));
  EXPECT_TRUE(refused([](ImitationParameters* p) { p->policy.encoder.views = 8; }));
}

}  // namespace
}  // namespace lstm_planner
