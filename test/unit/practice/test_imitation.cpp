#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "lstm_planner/practice/imitation.hpp"
#include "lstm_planner/training/confusion.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "support/refusal.hpp"

namespace lstm_planner::test_imitation {
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

/// What came of a round.
struct Round {
  std::size_t steps;
  DriveScore score;
  Eigen::VectorXf weights;
};

/// Steps and judges until the training is done.
std::vector<Round> finish(DriveImitation* training) {
  std::vector<Round> rounds;
  while (!training->done()) {
    training->step();
    if (!training->judgementDue()) continue;
    rounds.push_back(
        {training->drivenSteps(), training->judge(training->layers()), parameterVector(training->layers())});
  }
  return rounds;
}

TEST(Imitation, GivesTheSameWeightsForAnyNumberOfThreads) {
  std::vector<double> progress;
  DriveImitation alone(tinyImitation(1), [&](double share) { progress.push_back(share); });
  DriveImitation shared(tinyImitation(2));
  const std::vector<Round> one = finish(&alone);
  const std::vector<Round> two = finish(&shared);
  ASSERT_EQ(one.size(), 2u);
  for (std::size_t round = 0; round < 2; ++round) {
    EXPECT_GT(one[round].weights.size(), 0);
    EXPECT_EQ(one[round].weights, two[round].weights);
    EXPECT_EQ(one[round].steps, two[round].steps);
    EXPECT_EQ(one[round].score.arrival, two[round].score.arrival);
  }
  EXPECT_GT(one[1].steps, one[0].steps);  // everything collected before is kept

  ASSERT_FALSE(progress.empty());
  for (std::size_t i = 1; i < progress.size(); ++i) EXPECT_GT(progress[i], progress[i - 1]);
  EXPECT_DOUBLE_EQ(progress.back(), 1.0);
}

TEST(Imitation, GoesOnFromACheckpointAfterAnyEpochAsIfNothingHadBeen) {
  DriveImitation whole(tinyImitation(2));
  std::vector<std::vector<std::uint8_t>> checkpoints;
  while (!whole.done()) {
    whole.step();
    if (whole.judgementDue()) whole.judge(whole.layers());
    checkpoints.push_back(whole.checkpoint());
  }
  ASSERT_EQ(checkpoints.size(), 4u);
  // After the second one nobody judges the learner, whose drives validate the next round.
  for (std::size_t done = 0; done < checkpoints.size(); ++done) {
    DriveImitation resumed(tinyImitation(2));
    resumed.restore(checkpoints[done]);
    finish(&resumed);
    EXPECT_EQ(parameterVector(resumed.layers()), parameterVector(whole.layers())) << done + 1 << " epochs";
    EXPECT_EQ(resumed.checkpoint(), whole.checkpoint()) << done + 1 << " epochs";
    EXPECT_EQ(resumed.drivenSteps(), whole.drivenSteps());
  }
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
  DriveImitation training(parameters);
  finish(&training);
  const std::vector<EpochReport> curve = training.curve();
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
  EXPECT_TRUE(refused([](ImitationParameters* p) { p->threads = 0; }));
  EXPECT_TRUE(refused([](ImitationParameters* p) { p->trainer.epochs = 0; }));
  EXPECT_TRUE(refused([](ImitationParameters* p) { p->policy.encoder.views = 8; }));
}

}  // namespace
}  // namespace lstm_planner::test_imitation
