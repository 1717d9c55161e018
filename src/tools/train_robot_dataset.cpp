#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iomanip>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/dataset/dataset.hpp"
#include "lstm_planner/dataset/dataset_edit.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "lstm_planner/practice/dataset_training.hpp"
#include "lstm_planner/training/confusion.hpp"
#include "lstm_planner/training/imitation_rounds.hpp"
#include "lstm_planner/training/learning_curve.hpp"
#include "lstm_planner/training/parameter_vector.hpp"
#include "lstm_planner/training/training_stability.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/train_robot.hpp"
#include "tools/training.hpp"

namespace lstm_planner {
namespace {

const Choices<LabelBalance> kBalances = {
    {"none", LabelBalance::kNone}, {"sqrt", LabelBalance::kSquareRoot}, {"inverse", LabelBalance::kInverse}};

/// What `lstm_planner train --dataset` is asked to do.
struct DatasetTrainingOptions {
  std::string command;  ///< the whole command line
  std::string task = "robot";
  std::string method = "dataset";
  std::vector<std::string> datasets;
  std::vector<std::string> validation_datasets;
  double validation_share = 0.25;  ///< of the steps, where there are no validation_datasets
  std::string preset = "stable";
  std::string init;  ///< model to start with; empty: a new network
  RobotNetworkOptions network;
  EncoderParameters encoder;  ///< of a new network; the range cap is the recordings'
  TrainingLoopOptions loop;
  int snapshots = 0;  ///< epochs from one to the next; 0: none
  std::string curve;  ///< PNG files; empty: none
  std::string confusion;
  std::string stability;
  std::uint64_t seed = 1;
  DatasetTrainingParameters training;  ///< `sequences.policy` is not known yet

  bool fromModel() const { return !init.empty(); }
};

/// The options on which the defaults of the others depend.
void readPreset(const std::vector<std::string>& arguments, DatasetTrainingOptions* options) {
  options->init = CommandLine::peek("init", arguments);
  if (const std::string preset = CommandLine::peek("preset", arguments); !preset.empty()) options->preset = preset;
  if (options->preset == "thesis") {
    options->training = thesisDatasetTraining();
  } else if (options->preset == "stable") {
    options->training = options->fromModel() ? fineTuning() : stableDatasetTraining();
  } else {
    throw std::invalid_argument("--preset is '" + options->preset + "', expected thesis or stable");
  }
}

void addDataOptions(DatasetTrainingOptions* o, CommandLine* line) {
  DatasetSequenceParameters& sequences = o->training.sequences;
  line->section("training data");
  line->addFiles("dataset", &o->datasets, "recorded drives, one file or more").required();
  line->addFiles("validation-dataset", &o->validation_datasets, "recorded drives for validation");
  line->add("validation-share", &o->validation_share, kAnyShare,
            "share of the steps for validation, in whole episodes, without --validation-dataset");
  line->add("label-distance", &sequences.label_distance, {0.0, 1000.0},
            "m; a label is the direction to the place that the driver reached after this distance; 0: at the next "
            "step, as recorded");
  line->add("sequence", &sequences.sequence_steps, {0, kAnyWindow.most},
            "steps of a training sequence; 0: whole episodes");
  line->add("burn-in", &sequences.burn_in_steps, {0, kAnyWindow.most},
            "steps before a sequence that only set the hidden state");
  line->addChoice("balance", &o->training.balance, kBalances, "weight of rare labels: none, sqrt or inverse");
  line->add("variants", &o->training.variants, {0, 1e4},
            "additional copies of each drive for training: turned, and every second one mirrored");
}

void addNetworkOptions(DatasetTrainingOptions* o, CommandLine* line) {
  line->section("the network");
  line->addFile("init", &o->init, "model file to start from; it determines layers and inputs").mayBeReplaced();
  line->addOutput("output", &o->loop.output, "ONNX file to write: the best epoch").required();
  line->addOutput("checkpoint", &o->loop.checkpoint, "checkpoint file: is written, and continued from if it exists");
  line->add("snapshots", &o->snapshots, {0, kAnyCount.most},
            "epochs between snapshots of the weights (thesis 4.2); each is a file named after --output and the epoch; "
            "0: no snapshots")
      .changesNoResult();
  addRobotNetworkOptions(&o->network, &o->encoder, line);
}

void addTrainingOptions(DatasetTrainingOptions* o, CommandLine* line) {
  TrainerParameters& trainer = o->training.trainer;
  line->section("training");
  line->add("task", &o->task, "robot");
  line->add("method", &o->method, "dataset; not needed with --dataset");
  line->add("preset", &o->preset, "stable, or thesis (Table 4.2); determines the defaults");
  line->add("epochs", &trainer.epochs, kAnyCount, "passes over the training set");
  addLossOption(&trainer.loss, line);
  line->add("rate", &trainer.optimiser.learning_rate, kAnyRate, "learning rate");
  line->add("batch", &trainer.batch_size, kAnyCount, "sequences per update");
  line->add("averaging", &trainer.averaging, kAnyShare,
            "weights are averaged: share of the old average that an update keeps; 0: no averaging");
  line->addSeed(&o->seed, "seed of all random numbers");
  line->add("threads", &trainer.threads, kAnyThreads, "number of threads; does not change the result")
      .changesNoResult();
}

void addPictureOptions(DatasetTrainingOptions* o, CommandLine* line) {
  line->section("pictures (PNG); a CSV file is written beside each");
  line->addOutput("curve", &o->curve, "accuracy and loss by epoch");
  line->addOutput("confusion", &o->confusion, "confusion matrix of labels and answers");
  line->addOutput("instability", &o->stability, "three measures of the accuracy of an epoch (thesis Figure 4.10)");
}

void check(const CommandLine& line, const DatasetTrainingOptions& o) {
  if (o.task != "robot") throw std::invalid_argument("--dataset trains the robot, --task is '" + o.task + "'");
  if (o.method != "dataset") {
    throw std::invalid_argument("--dataset and --method " + o.method + " exclude each other");
  }
  if (o.fromModel()) checkModelDecides(line);
  if (!o.validation_datasets.empty() && line.given("validation-share")) {
    throw std::invalid_argument("--validation-dataset and --validation-share exclude each other");
  }
  if (!o.stability.empty() && o.training.trainer.averaging <= 0.0) {
    throw std::invalid_argument("--instability compares with averaged weights, --averaging is 0");
  }
}

/// Returns false when only the help was asked for. Throws with a sentence for options that make no sense.
bool readDatasetTrainingOptions(const std::vector<std::string>& arguments, DatasetTrainingOptions* options) {
  readPreset(arguments, options);
  options->command = trainCommandLine(arguments);
  CommandLine line("train", "trains a network for the robot from recorded drives");
  addDataOptions(options, &line);
  addNetworkOptions(options, &line);
  addTrainingOptions(options, &line);
  addPictureOptions(options, &line);
  line.whenParsed([&] {
    options->training.trainer.seed = options->seed;
    options->loop.keep_last = true;  // by then the best epoch is chosen
    validate(options->training);
    check(line, *options);
    if (!options->fromModel()) finishRobotNetworkOptions(options->network, &options->encoder);
  });
  if (!line.parse(arguments)) return false;
  options->loop.settings = line.settings();
  options->loop.settings["instability"] = !options->stability.empty();  // is measured from the first epoch on
  return true;
}

const char* const kLabels = "label [deg]";

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

/// Drives that were recorded: all that there is to learn from is there from the start.
class RecordedCourse : public ImitationCourse {
 public:
  explicit RecordedCourse(DatasetTrainingSets sets) : sets_(std::move(sets)) {}
  std::vector<Sequence> collectTraining(int /*round*/, const LayerStack* /*learner*/) override {
    return std::move(sets_.training);
  }
  std::vector<Sequence> collectValidation(int /*round*/, const LayerStack* /*learner*/) override {
    return std::move(sets_.validation);
  }

 private:
  DatasetTrainingSets sets_;
};

/// The network before; `policy` is filled in.
LayerStack firstLayers(const DatasetTrainingOptions& options, const Dataset& training, PolicyDescription* policy) {
  if (!options.fromModel()) {
    *policy = policyOf(training);
    const double range_cap = policy->encoder.range_cap;
    policy->encoder = options.encoder;
    policy->encoder.range_cap = range_cap;
  }
  LayerStack layers = firstLayers(options.init, options.network.shape, options.seed, policy);
  if (options.fromModel()) DrivePolicy(*policy, layers);  // throws unless they fit together
  return layers;
}

DatasetTrainingSets readSets(const DatasetTrainingOptions& options, Dataset training) {
  const PolicyDescription& policy = options.training.sequences.policy;
  if (needsScans(training, policy)) training = readDatasets(options.datasets, true);
  DatasetSplit parts{std::move(training), readDatasetsFor(policy, options.validation_datasets)};
  if (options.validation_datasets.empty()) {
    parts = splitDataset(parts.training, options.validation_share, options.seed);
  }
  return makeTrainingSets(parts, options.training);
}

long stepsOf(const std::vector<long>& labels) { return std::accumulate(labels.begin(), labels.end(), 0L); }

/// How many labels of each kind there are, so that nobody takes the most frequent one for a result.
void printLabels(const DatasetTrainingParameters& training, const DatasetTrainingSets& sets) {
  std::string headings = kLabels;
  for (const std::string& name : namesOf(training.sequences.policy.actions))
    headings += "  " + std::string(6 - std::min<std::size_t>(6, name.size()), ' ') + name;
  const TextTable table(headings);
  const auto line = [&table](const char* title, const auto& values, const auto& toText) {
    std::vector<std::string> cells{leftText(title, std::strlen(kLabels))};
    for (const auto& value : values) cells.push_back(toText(value));
    return table.line(cells);
  };
  const auto count = [](long labels) { return std::to_string(labels); };
  std::cout << headings << '\n'
            << line("training", sets.training_labels, count) << "   " << stepsOf(sets.training_labels)
            << " steps; with --variants " << training.variants << ' ' << sets.training.size() << " sequences\n"
            << line("validation", sets.validation_labels, count) << "   " << stepsOf(sets.validation_labels)
            << " steps in " << sets.validation.size() << " episodes\n"
            << line("weight", sets.label_weights, [](double weight) { return fixedText(weight, 2); }) << "   --balance "
            << nameOf(training.balance, kBalances) << "\nmajority-class baseline: accuracy "
            << percentText(constantAnswerAccuracy(sets.validation_labels)) << " on the validation set" << std::endl;
}

/// A network that always gives one answer has a high accuracy where that answer is frequent.
void warnNearChance(const LossSum& validation) {
  constexpr double kNear = 0.1;
  const double chance = balancedAccuracy(constantAnswer(validation.confusion));
  const double balanced = balancedAccuracy(validation.confusion);
  if (balanced >= chance + kNear * (1.0 - chance)) return;
  std::cout << "warning: the balanced accuracy of " << percentText(balanced) << " is near the " << percentText(chance)
            << " of always giving the same answer: the network has not learned to steer" << std::endl;
}

class DatasetTrainingHost : public ToolTrainingHost {
 public:
  DatasetTrainingHost(const DatasetTrainingOptions& options, const std::vector<long>& validation_labels,
                      const ImitationRounds& training)
      : ToolTrainingHost(options.loop), options_(options), validation_labels_(validation_labels), training_(training) {}

  void stepDone() override {
    const EpochReport& report = training_.epoch();
    printEpoch(report);
    if (options_.snapshots > 0 && report.epoch % options_.snapshots == 0) writeSnapshot(report);
    if (!options_.stability.empty()) {
      stability_.push_back(
          measureEpoch(training_.layers(), training_.state(), training_.training(), options_.training.trainer.threads));
    }
    ToolTrainingHost::stepDone();
  }

  double judge(const LayerStack& /*layers*/) override {
    seconds_ = std::chrono::steady_clock::now() - start_;
    return best().kept().accuracy();
  }

  void keep(const LayerStack& layers) override {
    writeModel(options_.loop.output, layers, best().kept());
    if (!options_.confusion.empty()) writeConfusion(options_.confusion, best().kept().confusion, names());
    if (!options_.stability.empty()) writeStability(options_.stability, stability_);
    if (!options_.curve.empty()) writeLearningCurve(options_.curve, training_.curve());
  }

  void judged(const Judgement& /*judgement*/) override {
    std::cout << training_.curve().size() << " epochs in " << fixedText(seconds_.count(), 1) << " s\n"
              << "validation set by the " << (options_.training.trainer.averaging > 0.0 ? "averaged " : "")
              << "weights of epoch " << best().epoch << ":\n"
              << confusionText(best().kept().confusion, names());
    warnNearChance(best().kept());
    if (!stability_.empty()) std::cout << stabilityText(stability_);
  }

  nlohmann::json notes() const override {
    nlohmann::json stability = nlohmann::json::array();
    for (const EpochAccuracies& epoch : stability_) {
      stability.push_back({epoch.epoch, epoch.moving, epoch.snapshot, epoch.averaged, epoch.validation_snapshot,
                           epoch.validation_averaged});
    }
    return {{"stability", stability}};
  }
  void restoreNotes(const nlohmann::json& progress) override {
    for (const nlohmann::json& epoch : progress.at("stability")) {
      stability_.push_back({epoch.at(0), epoch.at(1), epoch.at(2), epoch.at(3), epoch.at(4), epoch.at(5)});
    }
  }

 private:
  double progress() const override { return training_.progress(); }
  std::string position() const override { return std::to_string(training_.epochsOfRound()) + " epochs"; }
  std::string scoreText(double /*score*/) const override { return accuracyText(best().kept().confusion); }
  void printHeader() const override { std::cout << table_.headings() << std::endl; }

  EpochReport best() const { return training_.roundResult().best(); }
  std::vector<std::string> names() const { return namesOf(options_.training.sequences.policy.actions); }

  void printEpoch(const EpochReport& report) const {
    const int epochs = options_.training.trainer.epochs;
    const int interval = (epochs + kLines - 1) / kLines;
    if (report.epoch % interval != 0 && report.epoch != epochs) return;
    std::vector<std::string> cells = {std::to_string(report.epoch), fixedText(report.training.accuracy(), 4),
                                      fixedText(report.validation.accuracy(), 4)};
    if (report.averaged.confusion.size() > 0) cells.push_back(fixedText(report.averaged.accuracy(), 4));
    std::cout << table_.line(cells) << std::endl;
  }

  /// The weights of the epoch that ended last, not the averaged ones.
  void writeSnapshot(const EpochReport& report) const {
    LayerStack layers = training_.layers();
    setParameterVector(training_.state().weights, layers);
    const std::string epochs = std::to_string(options_.training.trainer.epochs);
    std::ostringstream path;
    path << options_.loop.output.substr(0, options_.loop.output.rfind(".onnx")) << "_epoch_" << std::setfill('0')
         << std::setw(static_cast<int>(epochs.size())) << report.epoch << ".onnx";
    writeModel(path.str(), layers, report.validation);
  }

  void writeModel(const std::string& path, const LayerStack& layers, const LossSum& validation) const {
    Model model;
    model.layers = layers;
    writeMetadata(options_.training.sequences.policy, &model.metadata);
    model.metadata["training_command"] = options_.command;
    model.metadata["score"] = std::to_string(stepsOf(validation_labels_)) +
                              " recorded validation steps: " + accuracyText(validation.confusion) +
                              "; majority-class baseline: " + percentText(constantAnswerAccuracy(validation_labels_));
    writeModelFile(path, model);
  }

  const TextTable table_{"epoch  training accuracy  validation accuracy  of the averaged weights"};
  const DatasetTrainingOptions& options_;
  const std::vector<long> validation_labels_;
  const ImitationRounds& training_;
  std::vector<EpochAccuracies> stability_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::duration<double> seconds_{};  ///< of the training, when its network was judged
};

}  // namespace

int trainRobotByDataset(const std::vector<std::string>& arguments) {
  DatasetTrainingOptions options;
  if (!readDatasetTrainingOptions(arguments, &options)) return 0;
  Dataset recorded = readDatasets(options.datasets, false);
  const LayerStack layers = firstLayers(options, recorded, &options.training.sequences.policy);
  DatasetTrainingSets sets = readSets(options, std::move(recorded));
  printLabels(options.training, sets);
  const TrainerParameters& trainer = options.training.trainer;
  if (options.fromModel()) {
    const LossSum before = evaluate(layers, sets.validation, trainer.threads);
    std::cout << options.init << " as it is: " << accuracyText(before.confusion) << std::endl;
  }
  const std::vector<long> validation_labels = sets.validation_labels;
  ImitationRounds training({1, 0, trainer}, layers, std::make_unique<RecordedCourse>(std::move(sets)));
  DatasetTrainingHost host(options, validation_labels, training);
  return host.end(runTraining(options.loop, &training, &host));
}

}  // namespace lstm_planner
