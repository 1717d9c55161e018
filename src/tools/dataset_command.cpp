#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/common/output_file.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/common/words.hpp"
#include "lstm_planner/dataset/dataset_check.hpp"
#include "lstm_planner/dataset/dataset_edit.hpp"
#include "lstm_planner/dataset/dataset_export.hpp"
#include "lstm_planner/dataset/dataset_summary.hpp"
#include "lstm_planner/practice/dataset_sequences.hpp"
#include "lstm_planner/practice/encoded_export.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/dataset_report.hpp"
#include "tools/train_robot.hpp"

namespace lstm_planner {

namespace {

const std::vector<double> kLabelDistances = {0.0, 0.2, 0.4, 0.6, 0.8, 1.0};  // m

}  // namespace

int datasetInfo(const std::vector<std::string>& arguments) {
  std::string file;
  std::string picture;
  CommandLine line("dataset info", "prints what a dataset contains; also during a recording");
  line.addFile("file", &file, "the dataset").required().standsAlone();
  line.addOutput("picture", &picture, "draw labels, ranges and driven paths into this PNG file");
  if (!line.parse(arguments)) return 0;
  const Dataset dataset = readDataset(file, true);
  printDatasetSummary(std::cout, summarise(dataset));
  if (!picture.empty()) drawDataset(picture, dataset);
  return 0;
}

int datasetCheck(const std::vector<std::string>& arguments) {
  std::string file;
  std::size_t most = 20;
  CommandLine line("dataset check", "checks a dataset for errors; the exit status is 1 if there are any");
  line.addFile("file", &file, "the dataset").required().standsAlone();
  line.add("most", &most, {0, 1e9}, "number of errors to print at most");
  if (!line.parse(arguments)) return 0;
  const std::vector<std::string> sentences = checkDatasetFile(file);
  for (std::size_t i = 0; i < std::min(most, sentences.size()); ++i) std::cout << sentences[i] << "\n";
  if (sentences.size() > most) std::cout << "... and " << sentences.size() - most << " more\n";
  if (sentences.empty()) std::cout << "nothing is wrong with " << stepCount(readDataset(file)) << " steps\n";
  return sentences.empty() ? 0 : 1;
}

int datasetMerge(const std::vector<std::string>& arguments) {
  std::vector<std::string> files;
  std::string output;
  CommandLine line("dataset merge", "joins the recordings of several datasets in a new one");
  line.addFiles("files", &files, "the datasets").required().standsAlone();
  line.addNewFile("output", &output, "the new dataset; the file must not exist").required();
  if (!line.parse(arguments)) return 0;
  const Dataset merged = mergeDatasets(files);
  writeDataset(output, merged);
  std::cout << files.size() << " datasets, " << merged.recordings.size() << " recordings, " << stepCount(merged)
            << " steps\n";
  return 0;
}

namespace {

void printPart(const char* name, const Dataset& part) {
  const DatasetSummary summary = summarise(part);
  std::cout << name << ": " << summary.episodes << " episodes, " << summary.steps << " steps\n";
  printLabels(std::cout, summary);
}

}  // namespace

int datasetSplit(const std::vector<std::string>& arguments) {
  std::string file;
  std::string training;
  std::string validation;
  double share = 0.25;
  std::uint64_t seed = 1;
  CommandLine line("dataset split", "divides a dataset into a training set and a validation set, by whole episodes");
  line.addFile("file", &file, "the dataset").required().standsAlone();
  line.add("share", &share, kAnyShare, "share of the steps for the validation set");
  line.addSeed(&seed, "seed of the random choice of episodes");
  line.addNewFile("training", &training, "new dataset with the training set").required();
  line.addNewFile("validation", &validation, "new dataset with the validation set").required();
  if (!line.parse(arguments)) return 0;
  const DatasetSplit split = splitDataset(readDataset(file, true), share, seed);
  writeDataset(training, split.training);
  try {
    writeDataset(validation, split.validation);
  } catch (const DatasetError&) {
    std::filesystem::remove(training);
    throw;
  }
  printPart("training", split.training);
  printPart("validation", split.validation);
  return 0;
}

namespace {

std::string degreesText(const ActionSet& actions) {
  std::string text;
  for (const double angle : actions.angles()) {
    text += (text.empty() ? "" : " ") + std::to_string(std::lround(angle * 180.0 / M_PI));
  }
  return text;
}

/// What `model convert` has to be told of a network for this policy: options for all that it would not assume.
std::string conversionOptions(const PolicyDescription& policy) {
  const PolicyDescription assumed;
  std::string options;
  const auto addText = [&](const std::string& name, const std::string& text, const std::string& assumed_text) {
    if (text != assumed_text) options += " --" + name + " " + text;
  };
  const auto add = [&](const std::string& name, double value, double assumed_value) {
    addText(name, numberText(value), numberText(assumed_value));
  };
  addText("layout", joined(policy.encoder.input_layout, " "), joined(assumed.encoder.input_layout, " "));
  add("range-cap", policy.encoder.range_cap, assumed.encoder.range_cap);
  add("position-cell", policy.encoder.position_cell, assumed.encoder.position_cell);
  add("heading-cell", policy.encoder.heading_cell, assumed.encoder.heading_cell);
  add("event-range", policy.encoder.event_range, assumed.encoder.event_range);
  addText("actions", degreesText(policy.actions), degreesText(assumed.actions));
  add("step-length", policy.step_length, assumed.step_length);
  add("robot-radius", policy.footprint_radius, assumed.footprint_radius);
  return options;
}

/// Returns what to do with a network that learns from it. `encoder` says which inputs; the range cap is the
/// recordings'.
std::string exportEncoded(const std::string& output, const Dataset& dataset, EncoderParameters encoder) {
  PolicyDescription policy = policyOf(dataset);
  encoder.range_cap = policy.encoder.range_cap;
  policy.encoder = encoder;
  exportEncodedCsv(output, dataset, policy, kLabelDistances);
  return "a network that learns from it is made usable by\nlstm_planner model convert FILE.onnx --output own.onnx" +
         conversionOptions(policy) + "\n";
}

}  // namespace

int datasetExport(const std::vector<std::string>& arguments) {
  std::string file;
  std::string output;
  bool with_scans = false;
  bool encoded = false;
  std::vector<std::string> inputs;
  EncoderParameters encoder;
  CommandLine line("dataset export", "writes a dataset for other programs; discarded episodes are left out");
  line.addFile("file", &file, "the dataset").required().standsAlone();
  line.addFile("output", &output, "FILE.csv: one row per step; FILE.npz: arrays for NumPy").required();
  line.addFlag("scans", &with_scans, true, "also write the whole scans");
  line.addFlag("encoded", &encoded, true,
               "write the encoded inputs of a network, and the labels 0 to 1 m ahead, instead of the measured values");
  line.section("which inputs, with --encoded");
  addInputOptions(&inputs, &encoder, &line);
  if (!line.parse(arguments)) return 0;
  const std::string extension = std::filesystem::path(output).extension().string();
  if (extension != ".csv" && extension != ".npz") {
    throw std::invalid_argument("--output is '" + output + "', expected a name that ends in .csv or .npz");
  }
  if (!encoded) line.refuseIdle({"inputs", "event-range", "position-cell", "heading-cell"}, "without --encoded");
  addInputs(inputs, &encoder);
  if (encoded && with_scans) throw std::invalid_argument("--encoded and --scans exclude each other");
  if (encoded && extension != ".csv") {
    throw std::invalid_argument("--output is '" + output + "', expected a name that ends in .csv, with --encoded");
  }
  const Dataset dataset = readDataset(file, with_scans);
  std::error_code unknown;
  if (std::filesystem::equivalent(file, output, unknown)) {
    throw std::invalid_argument("--output is the dataset itself, '" + file + "'");
  }
  checkWritable(output);
  std::string then;
  if (encoded) {
    then = exportEncoded(output, dataset, encoder);
  } else {
    (extension == ".csv" ? exportCsv : exportNumpy)(output, dataset, with_scans);
  }
  std::cout << stepCount(dataset) << " steps\n" << then;
  return 0;
}

int runDataset(const std::vector<std::string>& arguments) {
  static const std::vector<Command> actions = {
      {"info", "print what a dataset contains, and draw it", datasetInfo},
      {"check", "check a dataset for errors", datasetCheck},
      {"merge", "join several datasets", datasetMerge},
      {"split", "divide a dataset into a training set and a validation set", datasetSplit},
      {"export", "write a dataset as CSV or for NumPy", datasetExport},
      {"from-bag", "make a dataset from bags", datasetFromBag},
      {"from-log", "make a dataset from CARMEN logs", datasetFromLog},
      {"simulate", "let a program drive a simulated robot, and record it", datasetSimulate},
  };
  return runAction("dataset", actions, arguments);
}

}  // namespace lstm_planner
