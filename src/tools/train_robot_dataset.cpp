#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <utility>

#include "lstm_planner/base/learning/confusion.hpp"
#include "lstm_planner/base/learning/initialisation.hpp"
#include "lstm_planner/base/learning/learning_curve.hpp"
#include "lstm_planner/base/learning/parameter_vector.hpp"
#include "lstm_planner/base/learning/training_stability.hpp"
#include "lstm_planner/base/network/model_file.hpp"
#include "lstm_planner/robot/dataset/dataset.hpp"
#include "lstm_planner/robot/dataset/dataset_edit.hpp"
#include "tools/interruption.hpp"
#include "tools/progress.hpp"
#include "tools/ranks.hpp"
#include "tools/recorded_datasets.hpp"
#include "tools/train_commands.hpp"
#include "tools/train_robot_dataset_options.hpp"
#include "tools/train_robot_options.hpp"

namespace lstm_planner {

namespace {

constexpr int kLines = 20;  ///< printed, at most, besides the last

/// Like "-45": degrees, to the left positive.
std::vector<std::string> namesOf(const ActionSet& actions) {
  std::vector<std::string> names;
  for (const double angle : actions.angles()) {
    std::ostringstream name;
    name << std::round(angle * 1800.0 / M_PI) / 10.0;
    names.push_back(name.str());
  }
  return names;
}

class DatasetTraining {
 public:
  explicit DatasetTraining(DatasetTrainingOptions options) : options_(std::move(options)) {
    Dataset training = readDatasets(options_.datasets, false);
    makePolicy(training);
    const PolicyDescription& policy = options_.training.sequences.policy;
    if (needsScans(training, policy)) training = readDatasets(options_.datasets, true);
    DatasetSplit parts{std::move(training), readDatasetsFor(policy, options_.validation_datasets)};
    if (options_.validation_datasets.empty()) {
      parts = splitDataset(parts.training, options_.validation_share, options_.seed);
    }
    sets_ = makeTrainingSets(parts, options_.training);
  }

  int run() {
    printLabels();
    const LossSum before = evaluate(layers_, sets_.validation, options_.training.trainer.threads);
    if (options_.fromModel())
      std::cout << options_.init << " as it is: " << accuracyText(before.confusion) << std::endl;
    const Interruption interruption;
    const auto begun = std::chrono::steady_clock::now();
    std::cout << "epoch  training accuracy  validation accuracy  of the averaged weights" << std::endl;
    TrainingState state;
    Trainer trainer(layers_, sets_.training, sets_.validation, options_.training.trainer, &state);
    bool interrupted = false;
    while (!trainer.done() && !interrupted) {
      const EpochReport& report = trainer.runEpoch();
      printEpoch(report);
      if (options_.snapshots > 0 && report.epoch % options_.snapshots == 0) writeSnapshot(state);
      bar_.show(static_cast<double>(report.epoch) / options_.training.trainer.epochs);
      if (!options_.stability.empty()) {
        stability_.push_back(measureEpoch(layers_, state, sets_.training, options_.training.trainer.threads));
      }
      interrupted = interruption.wanted();
    }
    const TrainingResult result = trainer.result();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begun;
    std::cout << result.curve.size() << " epochs in " << std::setprecision(1) << seconds.count() << " s" << std::endl;
    finish(result);
    if (!interrupted) return 0;
    std::cout << "interrupted; this was the best until then" << std::endl;
    return interruption.exitStatus();
  }

 private:
  void makePolicy(const Dataset& training) {
    PolicyDescription& policy = options_.training.sequences.policy;
    if (options_.fromModel()) {
      Model model = readModelFile(options_.init);
      policy = readPolicyDescription(model.metadata);
      layers_ = std::move(model.layers);
      DrivePolicy(policy, layers_);  // throws unless they fit together
      return;
    }
    policy = policyOf(training);
    const double range_cap = policy.encoder.range_cap;
    policy.encoder = options_.encoder;
    policy.encoder.range_cap = range_cap;
    const int inputs = static_cast<int>(policy.encoder.input_layout.size());
    layers_ = makeNetwork(inputs, options_.network.shape, policy.actions.size());
    initialise({}, options_.seed, layers_);
  }

  /// How many labels of each kind there are, so that nobody takes the most frequent one for a result.
  void printLabels() const {
    const std::vector<std::string> names = namesOf(options_.training.sequences.policy.actions);
    std::cout << std::fixed << std::setprecision(2) << "label [deg]";
    for (const std::string& name : names) std::cout << std::setw(8) << name;
    const auto print = [](const char* title, const auto& values) {
      std::cout << std::left << std::setw(11) << title << std::right;
      for (const auto& value : values) std::cout << std::setw(8) << value;
    };
    std::cout << "\n";
    print("training", sets_.training_labels);
    std::cout << "   " << stepsOf(sets_.training_labels) << " steps; with --variants " << options_.training.variants
              << ' ' << sets_.training.size() << " sequences\n";
    print("validation", sets_.validation_labels);
    std::cout << "   " << stepsOf(sets_.validation_labels) << " steps in " << sets_.validation.size() << " episodes\n";
    print("weight", sets_.label_weights);
    std::cout << "   --balance " << toString(options_.training.balance) << "\nmajority-class baseline: accuracy "
              << percentText(constantAnswerAccuracy(sets_.validation_labels)) << " on the validation set" << std::endl;
  }

  static long stepsOf(const std::vector<long>& labels) {
    long steps = 0;
    for (const long count : labels) steps += count;
    return steps;
  }

  void printEpoch(const EpochReport& report) const {
    const int epochs = options_.training.trainer.epochs;
    const int interval = (epochs + kLines - 1) / kLines;
    if (report.epoch % interval != 0 && report.epoch != epochs) return;
    std::cout << std::setw(5) << report.epoch << std::setprecision(4) << std::setw(19) << report.training.accuracy()
              << std::setw(21) << report.validation.accuracy();
    if (report.averaged.confusion.size() > 0) std::cout << std::setw(25) << report.averaged.accuracy();
    std::cout << std::endl;
  }

  void finish(const TrainingResult& result) const {
    const EpochReport& best = result.best();
    const PolicyDescription& policy = options_.training.sequences.policy;
    const std::vector<std::string> names = namesOf(policy.actions);
    std::cout << "validation set by the " << (options_.training.trainer.averaging > 0.0 ? "averaged " : "")
              << "weights of epoch " << best.epoch << ":\n"
              << confusionText(best.kept().confusion, names);
    warnNearChance(best.kept());
    if (!stability_.empty()) std::cout << stabilityText(stability_);
    if (!isFirstRank()) return;
    writeModel(options_.output, result.layers, best.kept());
    std::cout << "wrote " << options_.output << ": " << accuracyText(best.kept().confusion) << std::endl;
    if (!options_.confusion.empty()) writeConfusion(options_.confusion, best.kept().confusion, names);
    if (!options_.stability.empty()) writeStability(options_.stability, stability_);
    if (!options_.curve.empty()) {
      const std::string stem = options_.curve.substr(0, options_.curve.rfind('.'));
      writeLearningCurve(stem + ".csv", options_.curve, result.curve);
    }
  }

  /// A network that always gives one answer has a high accuracy where that answer is frequent.
  static void warnNearChance(const LossSum& validation) {
    constexpr double kNear = 0.1;
    const double chance = balancedAccuracy(constantAnswer(validation.confusion));
    const double balanced = balancedAccuracy(validation.confusion);
    if (balanced >= chance + kNear * (1.0 - chance)) return;
    std::cout << "warning: the balanced accuracy of " << percentText(balanced) << " is near the " << percentText(chance)
              << " of always giving the same answer: the network has not learned to steer" << std::endl;
  }

  /// The weights of the epoch that ended last, not the averaged ones.
  void writeSnapshot(const TrainingState& state) const {
    if (!isFirstRank()) return;
    const EpochReport& report = state.curve.back();
    LayerStack layers = layers_;
    setParameterVector(state.weights, layers);
    const std::string epochs = std::to_string(options_.training.trainer.epochs);
    std::ostringstream path;
    path << options_.output.substr(0, options_.output.rfind(".onnx")) << "_epoch_" << std::setfill('0')
         << std::setw(static_cast<int>(epochs.size())) << report.epoch << ".onnx";
    writeModel(path.str(), layers, report.validation);
  }

  void writeModel(const std::string& path, const LayerStack& layers, const LossSum& validation) const {
    Model model;
    model.layers = layers;
    writeMetadata(options_.training.sequences.policy, &model.metadata);
    model.metadata["training_command"] = options_.command;
    model.metadata["score"] =
        std::to_string(stepsOf(sets_.validation_labels)) +
        " recorded validation steps: " + accuracyText(validation.confusion) +
        "; majority-class baseline: " + percentText(constantAnswerAccuracy(sets_.validation_labels));
    writeModelFile(path, model);
  }

  DatasetTrainingOptions options_;
  LayerStack layers_;
  DatasetTrainingSets sets_;
  std::vector<EpochAccuracies> stability_;
  Progress bar_;
};

}  // namespace

int trainRobotByDataset(const std::vector<std::string>& arguments) {
  DatasetTrainingOptions options;
  if (!readDatasetTrainingOptions(arguments, &options)) return 0;
  return DatasetTraining(std::move(options)).run();
}

}  // namespace lstm_planner
