#include "tools/train_grid_options.hpp"

#include <stdexcept>

#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/ranks.hpp"
#include "tools/training.hpp"

namespace lstm_planner {

void addGridMapOptions(GridTrainingOptions* options, CommandLine* line) {
  GridTrainingOptions& o = *options;
  line->addChoice("task", &o.task, {"grid", "robot"}, "grid (this) or robot");
  line->addFiles("maps", &o.maps,
                 "folders of the MovingAI benchmark's sets (with Maps and Scenarios in them), each DIR or DIR=WEIGHT; "
                 "maps 0-5 of a set (of more than 20 maps the first half) are for training, the others for validation "
                 "(default: generated caves, mazes and random fill)");
  line->add("map-size", &o.map_size, {16, 4096}, "cells; size of the generated maps");
  line->add("min-length", &o.min_length, kAnyLength, "cells, of the shortest path");
  line->add("max-length", &o.max_length, kAnyLength, "cells, of the shortest path");
  line->addFlag("thesis-terrain", &o.rule, PassableRule::kThesis, "only '.' is passable, not 'G' and 'S'");
  line->add("epochs", &o.epochs, kAnyCount, "number of epochs; with dagger: of each round");
  line->addSeed(&o.seed, "seed of all random numbers");
  line->add("threads", &o.threads, kAnyThreads, "number of threads; does not change the result").changesNoResult();
}

void addGridTrainingOptions(const std::vector<std::string>& arguments, GridTrainingOptions* options,
                            CommandLine* line) {
  GridTrainingOptions& o = *options;
  o.command = trainCommandLine(arguments);
  o.loop.communicator = ranks();
  addGridMapOptions(options, line);
  line->add("dead-ends", &o.dead_ends, kAnyShare,
            "share of the training episodes that start in a dead end, where there is one between the start and the "
            "goal: the blind spots of thesis ch. 5");
  line->add("method", &o.method, "imitation, dagger or q-learning");
  addShapeOptions(&o.shape, {64, 64, 64, 64}, line);
  line->addFile("from", &o.from, "ONNX file to start from, instead of random weights; it determines the layers");
  line->addOutput("output", &o.loop.output, "ONNX file to write: the best so far on the validation maps").required();
  line->addOutput("curve", &o.curve, "PNG file for the learning curve; a CSV file is written beside it");
  line->addOutput("checkpoint", &o.loop.checkpoint, "checkpoint file: is written, and continued from if it exists");
  line->add("validation", &o.validation, {1, 1e6}, "scenarios of each set, to judge the network");
  line->whenParsed([options] { makeNetwork(kGridInputs, options->shape, kGridMoveCount); });  // throws
}

LayerStack firstLayers(const GridTrainingOptions& options) {
  if (!options.from.empty()) {
    const Model model = readModelFile(options.from);
    try {
      checkGridMetadata(model.metadata);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("--from " + options.from + ": " + error.what());
    }
    return model.layers;
  }
  LayerStack layers = makeNetwork(kGridInputs, options.shape, kGridMoveCount);
  initialise({}, options.seed, layers);
  return layers;
}

}  // namespace lstm_planner
