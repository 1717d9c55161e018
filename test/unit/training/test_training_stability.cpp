#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "lstm_planner/training/initialisation.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "lstm_planner/training/training_stability.hpp"
#include "support/picture_check.hpp"
#include "support/refusal.hpp"
#include "support/scratch_folder.hpp"
#include "unit/training/toy_tasks.hpp"

namespace lstm_planner::test_training_stability {
namespace {

namespace fs = std::filesystem;

TEST(Fluctuation, IsThatOfTheLastEpochsOnly) {
  const Fluctuation fluctuation = fluctuationOf({0.1, 0.9, 0.8, 0.6, 0.8}, 4);
  EXPECT_NEAR(fluctuation.largest_change, 0.2, 1e-12);  // not the 0.8 before
  EXPECT_NEAR(fluctuation.usual_change, std::sqrt((0.01 + 0.04 + 0.04) / 3.0), 1e-12);
  EXPECT_NEAR(fluctuation.deviation, std::sqrt((2 * 0.025 * 0.025 + 0.125 * 0.125 + 0.175 * 0.175) / 4.0), 1e-12);
  EXPECT_EQ(fluctuation.lowest, 0.6);
  EXPECT_EQ(fluctuation.lowest_epoch, 4);
}

TEST(Fluctuation, OfNothingAndOfAConstantIsNone) {
  EXPECT_EQ(fluctuationOf({}, 10).deviation, 0.0);
  const Fluctuation constant = fluctuationOf({0.5, 0.5, 0.5}, 100);
  EXPECT_EQ(constant.deviation, 0.0);
  EXPECT_EQ(constant.usual_change, 0.0);
  EXPECT_EQ(constant.lowest_epoch, 1);
}

/// The settings of thesis table 4.2 on parities: updates of one sequence each.
TrainerParameters nervous(int epochs) {
  TrainerParameters parameters;
  parameters.epochs = epochs;
  parameters.batch_size = 1;
  parameters.threads = 1;
  parameters.averaging = 0.9;
  parameters.optimiser.kind = OptimiserKind::kMomentum;
  parameters.optimiser.schedule = LearningRateSchedule::kConstant;
  parameters.optimiser.learning_rate = 0.1;
  return parameters;
}

LayerStack startingLayers() { return initialised(makeLstmStack(3, {6}, 2), 3); }

TEST(TrainingStability, EachAccuracyIsOfTheWeightsThatItNames) {
  const std::vector<Sequence> training = recallSequences(60, 3, 1);
  const std::vector<Sequence> validation = recallSequences(40, 3, 2);
  TrainingState state;
  train(startingLayers(), training, validation, nervous(5), {}, &state);
  const EpochAccuracies epoch = measureEpoch(startingLayers(), state, training, 1);
  LayerStack layers = startingLayers();
  setParameterVector(state.weights, layers);
  EXPECT_EQ(epoch.snapshot, evaluate(layers, training).accuracy());
  EXPECT_EQ(epoch.validation_snapshot, evaluate(layers, validation).accuracy());
  setParameterVector(state.averaged_weights, layers);
  EXPECT_EQ(epoch.averaged, evaluate(layers, training).accuracy());
  EXPECT_EQ(epoch.validation_averaged, evaluate(layers, validation).accuracy());
  EXPECT_EQ(epoch.moving, state.curve.back().mean_batch_accuracy);
  EXPECT_EQ(epoch.epoch, 5);
}

TEST(TrainingStability, IsNotMeasuredWithoutAveraging) {
  TrainerParameters parameters = nervous(1);
  parameters.averaging = 0.0;
  const std::vector<Sequence> training = recallSequences(10, 3, 1);
  TrainingState state;
  train(startingLayers(), training, {}, parameters, {}, &state);
  EXPECT_EQ(test::refusalOf<std::invalid_argument>([&] { measureEpoch(startingLayers(), state, training, 1); }),
            "a training without averaged weights or epochs has no stability to be measured");
}

std::vector<EpochAccuracies> collapse() {
  std::vector<EpochAccuracies> epochs;
  for (int epoch = 1; epoch <= 250; ++epoch) {
    const double moving = epoch == 120 ? 0.4 : 0.8 + 0.02 * (epoch % 2);
    epochs.push_back({epoch, moving, 0.81, 0.85, 0.75, 0.8});
  }
  return epochs;
}

TEST(TrainingStability, TextNamesFluctuationsAndTheCollapse) {
  const std::string text = stabilityText(collapse());
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  EXPECT_NE(line.find("training, while the weights move"), std::string::npos);
  EXPECT_NE(line.find("1.00"), std::string::npos) << text;  // deviation of 80 and 82 %
  EXPECT_NE(line.find("2.00"), std::string::npos) << text;  // from one to the other
  EXPECT_NE(line.find("40.00       120"), std::string::npos) << text;
  EXPECT_NE(text.find("differ by 1.00 % on average, by 1.00 % at most"), std::string::npos) << text;
}

TEST(TrainingStability, PictureShowsTheCurvesAndTheCsvHasALineAnEpoch) {
  const test::ScratchFolder folder("a folder");
  writeStability(folder / "it.png", collapse());
  test::expectPicture(folder / "it.png", 1000, 900);
  const std::string csv = folder.read("it.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 251);
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "epoch,moving,snapshot,averaged,validation_snapshot,validation_averaged");
  const auto refusal = [&](const std::string& name, const std::vector<EpochAccuracies>& epochs) {
    return test::refusalOf<std::runtime_error>([&] { writeStability(folder / name, epochs); });
  };
  EXPECT_EQ(refusal("none.png", {}), "stability '" + folder / "none.png" + "' has no epochs, expected at least one");
  EXPECT_NE(refusal("missing/it.png", collapse()).find("No such file or directory"), std::string::npos)
      << refusal("missing/it.png", collapse());
}

}  // namespace
}  // namespace lstm_planner::test_training_stability
