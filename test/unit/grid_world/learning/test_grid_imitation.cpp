#include <gtest/gtest.h>

#include <stdexcept>

#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/learning/grid_imitation.hpp"
#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "support/refusal.hpp"
#include "unit/grid_world/learning/grid_learning_fixtures.hpp"

namespace lstm_planner::test_grid_imitation {
namespace {

using Sets = std::vector<GridCourse::Set>;

GridImitationParameters tinyImitation() {
  GridImitationParameters parameters;
  parameters.course = smallCourse();
  parameters.dataset.steps = 300;
  parameters.dataset.sequence_steps = 40;
  parameters.dataset.burn_in_steps = 8;
  parameters.dataset.max_steps = 60;
  parameters.validation_steps = 100;
  parameters.batch_steps = 100;
  parameters.rounds = 2;
  parameters.trainer.epochs = 3;
  parameters.threads = 1;
  return parameters;
}

LayerStack smallNetwork(const std::vector<int>& cells) {
  return initialised(makeLstmStack(kGridInputs, cells, kGridMoveCount), 1);
}

std::unique_ptr<ImitationRounds> inCaves(const GridImitationParameters& parameters) {
  return gridImitation(parameters, smallNetwork({4}), {{smallCave(1)}}, {{smallCave(2)}});
}

/// Weights after all rounds.
Eigen::VectorXf weightsAfter(const std::unique_ptr<ImitationRounds>& rounds) {
  while (!rounds->done()) rounds->step();
  return parameterVector(rounds->layers());
}

/// Accuracy of going on as before, and of a random guess at the first step.
double accuracyOfGoingOn(const std::vector<Sequence>& sequences) {
  double right = 0.0;
  for (const Sequence& sequence : sequences) {
    right += 1.0 / kGridMoveCount;
    for (Eigen::Index step = 1; step < sequence.steps(); ++step) {
      right += sequence.labels[step] == sequence.labels[step - 1] ? 1.0 : 0.0;
    }
  }
  return right / static_cast<double>(countWeighted(sequences));
}

TEST(GridImitation, LearnsWhatTheInputsTell) {
  // Where nothing is in the way the answer depends on the angle to the goal and the move before, which are inputs. Most
  // steps go on as the one before: what is learned shows in how many of the others are right.
  GridImitationParameters parameters = tinyImitation();
  parameters.course.max_length = 8.0;
  parameters.dataset.steps = 10000;
  parameters.validation_steps = 1000;
  parameters.batch_steps = 200;
  parameters.rounds = 1;
  parameters.trainer.epochs = 30;
  parameters.trainer.optimiser.learning_rate = 0.02;
  const Sets open = {{PassableGrid(40, 40, true)}};
  const auto rounds = gridImitation(parameters, smallNetwork({8}), open, open);
  while (!rounds->done()) rounds->step();
  const LossSum validation = rounds->roundResult().best().validation;
  const double going_on = accuracyOfGoingOn(
      collectGridSequences(parameters.dataset, GridCourse(parameters.course, open, 1, 1), nullptr, 0.0, 1, 1));
  EXPECT_GT(going_on, 0.6);
  EXPECT_LT(1.0 - validation.accuracy(), (1.0 - going_on) / 2.0);
}

TEST(GridImitation, RoundsAddPathsThatTheLearnerLeads) {
  const auto rounds = inCaves(tinyImitation());
  std::vector<std::size_t> steps;
  while (!rounds->done()) {
    rounds->step();
    if (rounds->judgementDue()) steps.push_back(rounds->collectedSteps());
  }
  EXPECT_EQ(steps, (std::vector<std::size_t>{300, 600}));
}

TEST(GridImitation, GivesTheSameWeightsForAnyNumberOfThreads) {
  GridImitationParameters parameters = tinyImitation();
  const Eigen::VectorXf one = weightsAfter(inCaves(parameters));
  parameters.threads = 3;
  EXPECT_EQ(weightsAfter(inCaves(parameters)), one);
  parameters.seed = 2;
  EXPECT_NE(weightsAfter(inCaves(parameters)), one);
}

TEST(GridImitation, GoesOnAfterABreakAsIfThereHadBeenNone) {
  const Eigen::VectorXf whole = weightsAfter(inCaves(tinyImitation()));
  const auto first = inCaves(tinyImitation());
  for (int epoch = 0; epoch < 4; ++epoch) first->step();  // to the second round, on paths that the learner led
  const auto rest = inCaves(tinyImitation());
  rest->restore(first->checkpoint());
  EXPECT_EQ(weightsAfter(rest), whole);
}

TEST(GridImitation, ThesisTrainsAsInItsTables) {
  const GridImitationParameters thesis = thesisImitation();
  EXPECT_NO_THROW(validate(thesis));
  EXPECT_EQ(thesis.dataset.steps, 102400);
  EXPECT_EQ(thesis.validation_steps, 10240);
  EXPECT_EQ(thesis.course.max_length, 300.0);
  EXPECT_EQ(thesis.trainer.epochs, 500);
  EXPECT_EQ(thesis.trainer.optimiser.learning_rate, 0.1);
  EXPECT_EQ(thesis.trainer.optimiser.momentum, 0.95);
  EXPECT_EQ(thesis.trainer.optimiser.l1_decay, 1e-5);
}

TEST(GridImitation, RefusesParametersWithWhichNothingIsLearned) {
  const auto refused = [](void (*change)(GridImitationParameters*)) {
    return test::isRefused(tinyImitation(), change);
  };
  EXPECT_FALSE(refused([](GridImitationParameters*) {}));
  EXPECT_TRUE(refused([](GridImitationParameters* p) { p->rounds = 0; }));
  EXPECT_TRUE(refused([](GridImitationParameters* p) { p->batch_steps = 0; }));
  EXPECT_TRUE(refused([](GridImitationParameters* p) { p->validation_steps = 0; }));
  EXPECT_TRUE(refused([](GridImitationParameters* p) { p->threads = 0; }));
}

}  // namespace
}  // namespace lstm_planner::test_grid_imitation
