#include "tools/train_robot_dataset_options.hpp"

#include <stdexcept>

#include "tools/command_line.hpp"
#include "tools/network_options.hpp"
#include "tools/ranges.hpp"
#include "tools/ranks.hpp"
#include "tools/train_commands.hpp"

namespace lstm_planner {

namespace {

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
  line->addText(
      "balance", toString(o->training.balance),
      [=](const std::string& name) { o->training.balance = labelBalanceNamed(name); },
      "weight of rare labels: none, sqrt or inverse");
  line->add("variants", &o->training.variants, {0, 1e4},
            "additional copies of each drive for training: turned, and every second one mirrored");
}

void addNetworkOptions(DatasetTrainingOptions* o, CommandLine* line) {
  line->section("the network");
  line->addFile("init", &o->init, "model file to start from; it determines layers and inputs");
  line->addOutput("output", &o->output, "ONNX file to write: the best epoch").required();
  line->addOutput("checkpoint", &o->checkpoint, "checkpoint file: is written, and continued from if it exists");
  line->add("snapshots", &o->snapshots, {0, kAnyCount.most},
            "epochs between snapshots of the weights (thesis 4.2); each is a file named after --output and the epoch; "
            "0: no snapshots");
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
  line->add("clip", &trainer.optimiser.max_gradient_norm, {0.0, 1e9}, "longer gradients are shortened; 0: never");
  line->add("averaging", &trainer.averaging, kAnyShare,
            "weights are averaged: share of the old average that an update keeps; 0: no averaging");
  line->addSeed(&o->seed, "seed of all random numbers");
  line->add("threads", &trainer.threads, kAnyThreads, "number of threads; does not change the result");
}

void addPictureOptions(DatasetTrainingOptions* o, CommandLine* line) {
  line->section("pictures (PNG); a CSV file is written beside each");
  line->addOutput("curve", &o->curve, "accuracy and loss by epoch");
  line->addOutput("confusion", &o->confusion, "confusion matrix of labels and answers");
  line->addOutput("instability", &o->stability, "three measures of the accuracy of an epoch (thesis Figure 4.10)");
}

void check(const CommandLine& line, const DatasetTrainingOptions& o) {
  if (o.task != "robot") throw std::invalid_argument("--dataset trains the robot, --task is '" + o.task + "'");
  if (!o.method.empty() && o.method != "dataset") {
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

/// Everything that changes the result, by the names of the options.
nlohmann::json settingsOf(const DatasetTrainingOptions& o) {
  const DatasetTrainingParameters& training = o.training;
  const TrainerParameters& trainer = training.trainer;
  nlohmann::json settings = settingsOf(o.network, o.encoder);
  settings.update({{"task", "robot"},
                   {"method", "dataset"},
                   {"dataset", o.datasets},
                   {"validation-dataset", o.validation_datasets},
                   {"validation-share", o.validation_share},
                   {"preset", o.preset},
                   {"label-distance", training.sequences.label_distance},
                   {"sequence", training.sequences.sequence_steps},
                   {"burn-in", training.sequences.burn_in_steps},
                   {"balance", toString(training.balance)},
                   {"variants", training.variants},
                   {"init", o.init},
                   {"epochs", trainer.epochs},
                   {"loss", nameOf(trainer.loss, losses())},
                   {"rate", trainer.optimiser.learning_rate},
                   {"batch", trainer.batch_size},
                   {"clip", trainer.optimiser.max_gradient_norm},
                   {"averaging", trainer.averaging},
                   {"instability", !o.stability.empty()},
                   {"seed", o.seed}});
  return settings;
}

}  // namespace

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
    options->training.trainer.communicator = ranks();
    validate(options->training);
    check(line, *options);
    if (!options->fromModel()) finishRobotNetworkOptions(line, &options->network, &options->encoder);
    options->settings = settingsOf(*options);
  });
  return line.parse(arguments);
}

}  // namespace lstm_planner
