#include "tools/train_robot.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/common/words.hpp"
#include "lstm_planner/practice/dataset_sequences.hpp"
#include "lstm_planner/training/confusion.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/shared_file.hpp"
#include "tools/training.hpp"

namespace lstm_planner {
namespace {

/// A view may look away from where the robot went, and from where the scanner looks.
void fitInputsToViews(EncoderParameters* encoder) {
  std::vector<std::string>& layout = encoder->input_layout;
  const auto previous = std::find(layout.begin(), layout.end(), "previous_action");
  if (previous != layout.end()) {
    *previous = "previous_action_sin";
    layout.insert(previous + 1, "previous_action_cos");
  }
  for (int i = 0; i < kSectorCount; ++i) layout.push_back("seen_" + std::to_string(i));
  validate(*encoder);
}

/// The groups of networkInputs() but those that a network has anyway.
std::vector<std::string> groupsToAdd() {
  std::vector<std::string> groups;
  for (const NetworkInput& input : networkInputs()) {
    const std::string group = input.group;
    if (!contains(groups, group) && group != "thesis" && group != "views") groups.push_back(group);
  }
  return groups;
}

/// One number in place of sine and cosine.
void useAnglesAlone(std::vector<std::string>* layout) {
  for (const std::string angle : {"goal_bearing", "heading"}) {
    std::replace(layout->begin(), layout->end(), angle + "_sin", angle);
    layout->erase(std::remove(layout->begin(), layout->end(), angle + "_cos"), layout->end());
  }
}

}  // namespace

void addWorldKinds(std::vector<WorldKind>* worlds, CommandLine* line) {
  Choices<WorldKind> kinds;
  for (const WorldKind kind : worldKinds()) kinds.emplace_back(toString(kind), kind);
  line->addChoices("kinds", worlds, kinds,
                   "kinds of generated worlds: mazes offices corridors forest open rooms furnished (default: all)");
}

void addInputOptions(std::vector<std::string>* groups, EncoderParameters* encoder, CommandLine* line) {
  line->add("inputs", groups,
            "inputs in addition to the thesis's: events (a sector below --event-range), events-alone (instead of the "
            "ranges), angles (bearing and heading as angles instead of sine and cosine: the thesis's twelve inputs), "
            "visits (how often the robot was at the places a step away), trace (the same on three scales, how long "
            "ago, and the progress), motion (since the last step)");
  line->add("event-range", &encoder->event_range, {0.0, 1000.0}, "m; a sector with a smaller mean range is an event");
  line->add("position-cell", &encoder->position_cell, {0.0, 1000.0},
            "m; the position is rounded to multiples of this; 0: it is not rounded");
  line->add("heading-cell", &encoder->heading_cell, {0.0, M_PI},
            "rad; the heading is rounded to multiples of this; 0: it is not rounded");
}

void addInputs(const std::vector<std::string>& groups, EncoderParameters* encoder) {
  std::vector<std::string>& layout = encoder->input_layout;
  const std::vector<std::string> known = groupsToAdd();
  for (const std::string& group : groups) {
    if (group == "events-alone") {
      for (std::string& name : layout) {
        if (name.rfind("sector_", 0) == 0) name.replace(0, 7, "event_");
      }
    } else if (group == "angles") {
      useAnglesAlone(&layout);
    } else {
      if (!contains(known, group)) {
        std::string expected = "events-alone";
        for (const std::string& name : known) expected += ", " + name;
        throw std::invalid_argument("--inputs names '" + group + "', expected some of " + expected);
      }
      for (const std::string& name : inputsOfGroup(group)) layout.push_back(name);
    }
  }
  validate(*encoder);
}

void addRobotNetworkOptions(RobotNetworkOptions* options, EncoderParameters* encoder, CommandLine* line) {
  addInputOptions(&options->inputs, encoder, line);
  line->add("views", &encoder->views, {1, 8},
            "1: one output per angle; 8: the network is evaluated for each of eight directions, each with an output "
            "and a hidden state (only with reinforcement)");
  addShapeOptions(&options->shape, {64, 64}, line);
}

void checkModelDecides(const CommandLine& line) {
  checkModelDecides(line, "--init", {"inputs", "event-range", "position-cell", "heading-cell", "views"});
}

void finishRobotNetworkOptions(const RobotNetworkOptions& options, EncoderParameters* encoder) {
  addInputs(options.inputs, encoder);
  if (encoder->views != 1) fitInputsToViews(encoder);
  makeNetwork(static_cast<int>(encoder->input_layout.size()), options.shape, 1);  // throws
}

void addRobotTrainingOptions(const std::vector<std::string>& arguments, RobotTrainingOptions* options,
                             CommandLine* line) {
  RobotTrainingOptions& o = *options;
  o.command = trainCommandLine(arguments);
  o.loop.output = "own.onnx";  // never a model that ships with the package
  line->addChoice("task", &o.task, {"robot", "grid"}, "robot (this) or grid");
  line->add("method", &o.method, "dagger (default), actor-critic or dataset; --method NAME --help explains it");
  line->addOutput("output", &o.loop.output, "ONNX file to write");
  line->addOutput("checkpoint", &o.loop.checkpoint, "checkpoint file: is written, and continued from if it exists");
  addWorldKinds(&o.course.worlds, line);
  line->add("dead-ends", &o.course.dead_end_share, kAnyShare, "share of the drives that start in a dead end");
  line->add("shortest", &o.course.shortest, {0.01, 1e4}, "m; smallest length of the path from start to goal");
  line->add("max-steps", &o.max_steps, kAnyCount, "largest number of steps of a drive");
  line->add("validation", &o.validation, kAnyCount, "number of worlds for validation");
  line->addSeed(&o.seed, "seed of all random numbers");
  line->add("threads", &o.threads, kAnyThreads, "number of threads; does not change the result").changesNoResult();
  line->whenParsed([options] { validate(options->course); });
}

LayerStack firstLayers(const std::string& init, const NetworkShape& shape, std::uint64_t seed,
                       PolicyDescription* policy) {
  if (!init.empty()) {
    Model model = readModelFile(findSharedFile(init));
    try {
      *policy = readPolicyDescription(model.metadata);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("--init " + init + ": " + error.what());
    }
    return std::move(model.layers);
  }
  const int inputs = static_cast<int>(policy->encoder.input_layout.size());
  return initialised(makeNetwork(inputs, shape, networkOutputs(*policy)), seed);
}

void writeRobotModel(const RobotTrainingOptions& options, const PolicyDescription& policy, const LayerStack& layers,
                     const DriveScore& score) {
  Model model;
  model.layers = layers;
  writeMetadata(policy, &model.metadata);
  model.metadata["training_command"] = options.command;
  model.metadata["score"] =
      std::to_string(score.drives) + " validation drives by the network and the shield: " + toText(score);
  writeModelFile(options.loop.output, model);
}

std::string toText(const DriveScore& score) {
  return "arrival " + fixedText(score.arrival, 3) + ", efficiency " + fixedText(score.efficiency, 3);
}

Dataset readDatasets(const std::vector<std::string>& paths, bool with_scans) {
  Dataset all;
  for (auto path = paths.begin(); path != paths.end(); ++path) {
    std::error_code unknown;
    const auto is_this = [&](const std::string& other) { return std::filesystem::equivalent(other, *path, unknown); };
    if (std::any_of(paths.begin(), path, is_this)) {
      throw std::invalid_argument("dataset '" + *path + "' is given twice");
    }
    Dataset dataset = readDataset(*path, with_scans);
    std::move(dataset.recordings.begin(), dataset.recordings.end(), std::back_inserter(all.recordings));
  }
  return all;
}

Dataset readDatasetsFor(const PolicyDescription& policy, const std::vector<std::string>& paths) {
  Dataset dataset = readDatasets(paths, false);
  return needsScans(dataset, policy) ? readDatasets(paths, true) : dataset;
}

std::string accuracyText(const ConfusionMatrix& confusion) {
  return "accuracy " + percentText(accuracyOf(confusion)) + ", balanced " + percentText(balancedAccuracy(confusion));
}

}  // namespace lstm_planner
