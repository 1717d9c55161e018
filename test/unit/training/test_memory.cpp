#include <gtest/gtest.h>

#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/trainer.hpp"
#include "unit/training/toy_tasks.hpp"

namespace lstm_planner::test_memory {
namespace {

double accuracyAfterTraining(const LayerStack& layers, const std::vector<Sequence>& training,
                             const std::vector<Sequence>& test, int epochs) {
  TrainerParameters parameters;
  parameters.epochs = epochs;
  parameters.batch_size = 64;
  parameters.optimiser.learning_rate = 0.02;
  return evaluate(train(initialised(layers, 1), training, {}, parameters).layers, test).accuracy();
}

// Test sets hold 1,000 or more decisions, half of them each way: 0.08 is five standard deviations from chance.
constexpr double kChance = 0.5;
constexpr double kChanceTolerance = 0.08;

TEST(Memory, LstmRecallsTheFirstSymbolAfterTwentyStepsAndADenseStackCannot) {
  const auto training = recallSequences(1000, 20, 1);
  const auto test = recallSequences(1000, 20, 2);
  EXPECT_GT(accuracyAfterTraining(makeLstmStack(3, {8}, 2), training, test, 30), 0.99);
  EXPECT_NEAR(accuracyAfterTraining(makeDenseStack(3, {8, 8}, 2), training, test, 30), kChance, kChanceTolerance);
}

TEST(Memory, StackedLstmLearnsTheParityOfABitStreamAndADenseStackCannot) {
  const auto training = paritySequences(1000, 12, 1);
  const auto test = paritySequences(1000, 30, 2);  // longer than what it has learned from
  EXPECT_GT(accuracyAfterTraining(makeLstmStack(1, {8, 8}, 2), training, test, 60), 0.99);
  EXPECT_NEAR(accuracyAfterTraining(makeDenseStack(1, {8, 8}, 2), training, test, 60), kChance, kChanceTolerance);
}

}  // namespace
}  // namespace lstm_planner::test_memory
