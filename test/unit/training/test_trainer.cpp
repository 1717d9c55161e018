#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "lstm_planner/training/trainer.hpp"
#include "support/refusal.hpp"
#include "unit/training/toy_tasks.hpp"

namespace lstm_planner::test_trainer {
namespace {

LayerStack startingLayers() { return initialised(makeLstmStack(1, {6, 5}, 2), 3); }

LayerStack startingRecallLayers() { return initialised(makeLstmStack(3, {8}, 2), 1); }

/// Lengths differ, so that groups get different work and threads finish in any order.
std::vector<Sequence> raggedParitySequences() {
  std::vector<Sequence> sequences;
  for (int steps = 3; steps < 30; ++steps) {
    for (const Sequence& sequence : paritySequences(5, steps, static_cast<std::uint64_t>(steps))) {
      sequences.push_back(sequence);
    }
  }
  return sequences;
}

Eigen::VectorXf weightsAfterTraining(int threads, std::uint64_t seed) {
  TrainerParameters parameters;
  parameters.epochs = 3;
  parameters.batch_size = 40;
  parameters.threads = threads;
  parameters.seed = seed;
  return parameterVector(train(startingLayers(), raggedParitySequences(), {}, parameters).layers);
}

TEST(Trainer, WeightsAreTheSameBitForBitForAnyNumberOfThreads) {
  const Eigen::VectorXf one = weightsAfterTraining(1, 1);
  EXPECT_EQ(weightsAfterTraining(1, 1), one);
  EXPECT_EQ(weightsAfterTraining(2, 1), one);
  EXPECT_EQ(weightsAfterTraining(5, 1), one);
  EXPECT_EQ(weightsAfterTraining(20, 1), one);
  EXPECT_NE(weightsAfterTraining(1, 2), one);  // the order of the sequences matters, so the seed does
}

TEST(Trainer, LearnsATinySetByHeart) {
  Random random(4);
  std::vector<Sequence> sequences;
  for (int index = 0; index < 4; ++index) {
    Sequence sequence{Eigen::MatrixXf(1, 6), Eigen::VectorXi(6), Eigen::VectorXf::Ones(6)};
    for (int step = 0; step < 6; ++step) {
      sequence.inputs(0, step) = static_cast<float>(normal(random));
      sequence.labels[step] = static_cast<int>(uniformIndex(random, 2));
    }
    sequences.push_back(sequence);
  }
  TrainerParameters parameters;
  parameters.epochs = 400;
  parameters.optimiser.learning_rate = 0.03;
  const LossSum sum = evaluate(train(startingLayers(), sequences, {}, parameters).layers, sequences);
  EXPECT_EQ(sum.accuracy(), 1.0);
  EXPECT_LT(sum.meanLoss(), 0.05);
}

TEST(Trainer, MomentumLearnsToo) {
  TrainerParameters parameters;
  parameters.epochs = 60;
  parameters.optimiser.kind = OptimiserKind::kMomentum;
  parameters.optimiser.learning_rate = 0.1;  // thesis table 3.2: 0.1, 0.95, L1 with 1e-5
  parameters.optimiser.l1_decay = 1e-5;
  const auto sequences = recallSequences(256, 2, 1);
  EXPECT_GT(evaluate(train(startingRecallLayers(), sequences, {}, parameters).layers, sequences).accuracy(), 0.99);
}

TEST(Trainer, KeepsTheBestEpochOnTheValidationSet) {
  // The opposite of every label: the more is learned, the worse the validation, so that the last epoch is not the best.
  const auto training = recallSequences(256, 2, 1);
  auto validation = training;
  for (Sequence& sequence : validation) sequence.labels = 1 - sequence.labels.array();
  TrainerParameters parameters;
  parameters.epochs = 30;
  parameters.optimiser.learning_rate = 0.03;
  const TrainingResult result = train(startingRecallLayers(), training, validation, parameters);
  ASSERT_EQ(result.curve.size(), 30u);
  double best = 0.0;
  for (const EpochReport& report : result.curve) best = std::max(best, report.validation.accuracy());
  const EpochReport& kept = result.best();
  EXPECT_TRUE(kept.best);
  EXPECT_EQ(kept.validation.accuracy(), best);
  EXPECT_EQ(evaluate(result.layers, validation).confusion, kept.validation.confusion);
  EXPECT_LT(result.curve.back().validation.accuracy(), 0.01);
  EXPECT_LT(result.best_epoch, 30);
}

TEST(Trainer, StepGoesAgainstTheGradientOfTheMeanLossOverAllGroups) {
  const LayerStack layers = startingLayers();
  const auto sequences = raggedParitySequences();
  TrainerParameters parameters;
  parameters.epochs = 1;
  parameters.batch_size = static_cast<int>(sequences.size());
  parameters.optimiser.kind = OptimiserKind::kMomentum;
  parameters.optimiser.learning_rate = 0.5;
  parameters.optimiser.max_gradient_norm = 0.0;
  std::vector<const Sequence*> batch;
  for (const Sequence& sequence : sequences) batch.push_back(&sequence);
  const Eigen::VectorXf weights = parameterVector(layers);
  Eigen::VectorXf gradient;
  const LossSum sum = SequenceGradient(layers).loss(weights, batch, &gradient);
  const Eigen::VectorXf expected = weights - static_cast<float>(0.5 / sum.weight) * gradient;
  const Eigen::VectorXf trained = parameterVector(train(layers, sequences, {}, parameters).layers);
  EXPECT_LT((trained - expected).cwiseAbs().maxCoeff(), 1e-6f);  // single precision of weights below 2
  EXPECT_GT((expected - weights).norm(), 1e-3f);
}

TEST(Trainer, ReportsEachEpochAndEndsWhenTold) {
  TrainerParameters parameters;
  parameters.epochs = 10;
  std::vector<int> epochs;
  const auto training = paritySequences(20, 5, 1);
  const TrainingResult result = train(startingLayers(), training, {}, parameters, [&epochs](const EpochReport& report) {
    epochs.push_back(report.epoch);
    EXPECT_EQ(report.training.confusion.sum(), 20 * 5);
    return report.epoch < 3;
  });
  EXPECT_EQ(epochs, (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(result.curve.size(), 3u);
  EXPECT_EQ(result.best_epoch, 3);
}

TEST(Trainer, AveragingLeavesTheTrainingAsItIsAndKeepsTheAverage) {
  TrainerParameters parameters;
  parameters.epochs = 3;
  parameters.batch_size = 40;
  const std::vector<Sequence> training = raggedParitySequences();
  TrainingState plain;
  train(startingLayers(), training, {}, parameters, {}, &plain);
  EXPECT_EQ(plain.averaged_weights.size(), 0);
  EXPECT_EQ(plain.best_weights, plain.weights);
  parameters.averaging = 0.9;
  TrainingState averaged;
  const TrainingResult result = train(startingLayers(), training, {}, parameters, {}, &averaged);
  EXPECT_EQ(averaged.weights, plain.weights);
  EXPECT_EQ(parameterVector(result.layers), averaged.averaged_weights);
  EXPECT_NE(averaged.averaged_weights, averaged.weights);
}

TEST(Trainer, AverageForgetsSlowerTheMoreUpdatesThereWere) {
  // One update an epoch, so that the weights after each are seen.
  const auto sequences = paritySequences(20, 5, 1);
  TrainerParameters parameters;
  parameters.epochs = 12;
  parameters.averaging = 0.5;
  Eigen::VectorXf expected = parameterVector(startingLayers());
  TrainingState state;
  const auto follow = [&](const EpochReport& report) {
    // (1 + updates) / (10 + updates) reaches the half after 8 updates.
    const double kept = std::min(0.5, (1.0 + report.epoch) / (10.0 + report.epoch));
    expected += static_cast<float>(1.0 - kept) * (state.weights - expected);
    EXPECT_LT((state.averaged_weights - expected).cwiseAbs().maxCoeff(), 1e-6f) << "epoch " << report.epoch;
    return true;
  };
  train(startingLayers(), sequences, {}, parameters, follow, &state);
}

TEST(Trainer, BestEpochIsThatOfTheAveragedWeights) {
  TrainerParameters parameters;
  parameters.epochs = 15;
  parameters.batch_size = 8;
  parameters.optimiser.learning_rate = 0.05;
  parameters.averaging = 0.95;
  const auto training = recallSequences(128, 2, 1);
  const auto validation = recallSequences(64, 2, 2);
  const TrainingResult result = train(startingRecallLayers(), training, validation, parameters);
  double best = 0.0;
  for (const EpochReport& report : result.curve) {
    best = std::max(best, report.averaged.accuracy());
    EXPECT_EQ(report.kept().confusion, report.averaged.confusion);
  }
  const EpochReport& kept = result.best();
  EXPECT_EQ(kept.averaged.accuracy(), best);
  EXPECT_EQ(evaluate(result.layers, validation).confusion, kept.averaged.confusion);
}

TEST(Trainer, AccuracyOfAnEpochIsTheMeanOverItsBatches) {
  LayerStack layers = makeDenseStack(1, {}, 2);
  std::get<DenseLayer>(layers[0]).bias << 1.0f, 0.0f;  // always answers 0
  Sequence right{Eigen::MatrixXf::Zero(1, 4), Eigen::VectorXi::Zero(4), Eigen::VectorXf::Ones(4)};
  Sequence wrong{Eigen::MatrixXf::Zero(1, 1), Eigen::VectorXi::Ones(1), Eigen::VectorXf::Ones(1)};
  TrainerParameters parameters;
  parameters.epochs = 1;
  parameters.batch_size = 1;
  parameters.optimiser.learning_rate = 1e-6;  // as good as no update
  const EpochReport report = train(layers, {right, wrong}, {}, parameters).curve[0];
  EXPECT_DOUBLE_EQ(report.mean_batch_accuracy, 0.5);  // of 1 and 0
  EXPECT_DOUBLE_EQ(report.training.accuracy(), 0.8);  // of five steps
}

TEST(Trainer, GoesOnAfterABreakAsIfThereHadBeenNone) {
  for (const OptimiserKind kind : {OptimiserKind::kMomentum, OptimiserKind::kAdam, OptimiserKind::kAdaDelta}) {
    TrainerParameters parameters;
    parameters.epochs = 6;
    parameters.batch_size = 40;
    parameters.optimiser.kind = kind;
    parameters.averaging = kind == OptimiserKind::kMomentum ? 0.9 : 0.0;
    const std::vector<Sequence> training = raggedParitySequences();
    const std::vector<Sequence> validation = paritySequences(5, 12, 1);
    const TrainingResult whole = train(startingLayers(), training, validation, parameters);

    TrainingState state;
    const auto stop_after_two = [&](const EpochReport& report) { return report.epoch < 2; };
    train(startingLayers(), training, validation, parameters, stop_after_two, &state);
    ASSERT_EQ(state.curve.size(), 2u);
    const TrainingResult rest = train(startingLayers(), training, validation, parameters, {}, &state);
    EXPECT_EQ(parameterVector(rest.layers), parameterVector(whole.layers));
    EXPECT_EQ(rest.best_epoch, whole.best_epoch);
    ASSERT_EQ(rest.curve.size(), 6u);
    EXPECT_EQ(rest.curve.back().training.loss, whole.curve.back().training.loss);
    EXPECT_EQ(rest.curve.back().learning_rate, whole.curve.back().learning_rate);

    // Nothing is left to do: the best is still known.
    EXPECT_EQ(parameterVector(train(startingLayers(), training, validation, parameters, {}, &state).layers),
              parameterVector(whole.layers));
  }
}

TEST(Trainer, RefusesTheStateOfAnotherNetwork) {
  TrainerParameters parameters;
  parameters.epochs = 1;
  TrainingState state;
  train(startingLayers(), paritySequences(4, 5, 1), {}, parameters, {}, &state);
  parameters.epochs = 2;
  const auto refusal = [&](const LayerStack& layers) {
    return test::refusalOf<std::invalid_argument>(
        [&] { train(layers, paritySequences(4, 5, 1), {}, parameters, {}, &state); });
  };
  EXPECT_EQ(refusal(makeLstmStack(1, {3}, 2)), "the training's state has 444 weights, the layers have 68");
  parameters.averaging = 0.9;
  EXPECT_EQ(refusal(startingLayers()), "the training's state has 0 averaged weights, expected 444");
}

TEST(Trainer, ConfusionCountsLabelsByRowAndAnswersByColumn) {
  LayerStack layers = makeDenseStack(1, {}, 3);
  std::get<DenseLayer>(layers[0]).bias << 0.0f, 1.0f, 0.0f;  // always answers 1
  Sequence sequence{Eigen::MatrixXf::Zero(1, 5), Eigen::VectorXi(5), Eigen::VectorXf::Ones(5)};
  sequence.labels << 0, 1, 1, 2, 0;
  sequence.weights[4] = 0.0f;
  const LossSum sum = evaluate(layers, {sequence});
  ConfusionMatrix expected(3, 3);
  expected << 0, 1, 0, 0, 2, 0, 0, 1, 0;
  EXPECT_EQ(sum.confusion, expected);
  EXPECT_DOUBLE_EQ(sum.accuracy(), 0.5);
  EXPECT_DOUBLE_EQ(sum.weight, 4.0);
}

TEST(Trainer, SaysWhenTrainingDiverges) {
  TrainerParameters parameters;
  parameters.optimiser.kind = OptimiserKind::kMomentum;
  parameters.optimiser.learning_rate = 1e38;
  parameters.optimiser.max_gradient_norm = 0.0;
  const std::string sentence =
      test::refusalOf<std::runtime_error>([&] { train(startingLayers(), paritySequences(20, 5, 1), {}, parameters); });
  EXPECT_EQ(sentence.rfind("training diverged: the training loss of epoch ", 0), 0u) << sentence;
}

TEST(Trainer, RefusesBadParametersAndSets) {
  const LayerStack layers = startingLayers();
  const auto good = paritySequences(4, 5, 1);
  const auto refusal = [&](const std::vector<Sequence>& sequences, const TrainerParameters& parameters) {
    return test::refusalOf<std::invalid_argument>([&] { train(layers, sequences, {}, parameters); });
  };
  const auto refused = [&](auto change, const std::string& reason) {
    TrainerParameters parameters;
    change(parameters);
    EXPECT_EQ(refusal(good, parameters), "parameter " + reason);
  };
  refused([](TrainerParameters& p) { p.epochs = 0; }, "epochs is 0, expected at least 1");
  refused([](TrainerParameters& p) { p.batch_size = 0; }, "batch_size is 0, expected at least 1");
  refused([](TrainerParameters& p) { p.threads = -1; }, "threads is -1, expected at least 1");
  refused([](TrainerParameters& p) { p.averaging = 1.0; }, "averaging is 1, expected a share in [0, 1)");
  refused([](TrainerParameters& p) { p.optimiser.learning_rate = -1.0; },
          "learning_rate is -1, expected a positive number");
  EXPECT_EQ(refusal({}, {}), "training set of 0 sequences has no step with a weight above 0, expected at least one");
  auto without_weights = good;
  for (Sequence& sequence : without_weights) sequence.weights.setZero();
  EXPECT_EQ(refusal(without_weights, {}),
            "training set of 4 sequences has no step with a weight above 0, expected at least one");
  EXPECT_EQ(evaluate(layers, {}).accuracy(), 0.0);
}

}  // namespace
}  // namespace lstm_planner::test_trainer
