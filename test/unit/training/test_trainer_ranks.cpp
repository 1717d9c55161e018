#include <gtest/gtest.h>

#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "lstm_planner/training/trainer.hpp"
#include "unit/training/thread_ranks.hpp"
#include "unit/training/toy_tasks.hpp"

namespace lstm_planner::test_trainer_ranks {
namespace {

struct Outcome {
  Eigen::VectorXf weights;
  std::vector<double> curve;
  std::vector<std::int64_t> counts;  ///< of right and wrong answers
};

Outcome trainOn(Communicator* communicator) {
  const LayerStack layers = initialised(makeLstmStack(1, {6, 5}, 2), 3);
  std::vector<Sequence> training;
  for (int steps = 3; steps < 12; ++steps) {
    for (const Sequence& sequence : paritySequences(5, steps, static_cast<std::uint64_t>(steps))) {
      training.push_back(sequence);
    }
  }
  TrainerParameters parameters;
  parameters.epochs = 3;
  parameters.batch_size = 40;  // three groups
  parameters.threads = 1;
  parameters.communicator = communicator;
  const TrainingResult result = train(layers, training, paritySequences(3, 8, 1), parameters);
  Outcome outcome;
  outcome.weights = parameterVector(result.layers);
  for (const EpochReport& report : result.curve) {
    outcome.curve.insert(outcome.curve.end(), {report.training.loss, report.training.weight, report.validation.loss,
                                               report.validation.weight, report.best ? 1.0 : 0.0});
    for (const LossSum* sum : {&report.training, &report.validation}) {
      outcome.counts.insert(outcome.counts.end(), sum->confusion.data(), sum->confusion.data() + sum->confusion.size());
    }
  }
  return outcome;
}

TEST(Trainer, AnyNumberOfRanksLearnsTheSameWeightsAndReportsTheSame) {
  const Outcome one = trainOn(oneProcess());
  for (const int ranks : {2, 3, 9}) {  // 9: more ranks than there are groups
    for (const Outcome& outcome : onRanks(ranks, trainOn)) {
      EXPECT_EQ(outcome.weights, one.weights) << ranks << " ranks";
      EXPECT_EQ(outcome.curve, one.curve) << ranks << " ranks";
      EXPECT_EQ(outcome.counts, one.counts) << ranks << " ranks";
    }
  }
}

}  // namespace
}  // namespace lstm_planner::test_trainer_ranks
