#include "tools/train_grid.hpp"

#include <functional>
#include <iomanip>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "lstm_planner/common/parallel_for.hpp"
#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/grid/map_generators.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/agent/network_grid_agent.hpp"
#include "lstm_planner/grid_world/evaluation/grid_evaluation.hpp"
#include "lstm_planner/grid_world/world/scenario_generator.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"

namespace lstm_planner {
namespace {

constexpr int kTrainingMaps = 6;
constexpr int kValidationMaps = 4;

void addSet(const GridSetFiles& files, const GridTrainingOptions& options, GridTrainingMaps* maps) {
  GridCourse::Set training;
  for (const GridMapFiles& map : selectMaps(files, MapSelection::kTrain)) {
    training.push_back(readMovingAiMap(mapOfScenarioFile(map.scenario_files.front()), options.rule));
  }
  if (training.empty()) throw std::invalid_argument("set " + files.name + " has no training maps");
  ScenarioSelection selection;
  selection.maps = MapSelection::kValidation;
  selection.min_length = options.min_length;
  selection.max_length = options.max_length;
  selection.rule = options.rule;
  selection.count = static_cast<std::size_t>(options.validation);
  maps->training.push_back(std::move(training));
  maps->validation.push_back(drawGridTasks(files, selection));
}

/// Scenarios of all lengths of the range alike, as many from each map.
GridTaskSet drawTasks(const std::string& name, const std::vector<PassableGrid>& grids,
                      const GridTrainingOptions& options) {
  GridTaskSet set;
  set.name = name;
  for (std::size_t map = 0; map < grids.size(); ++map) {
    Random random(options.seed + map);
    std::vector<GridTask> tasks;
    for (const Scenario& scenario : drawScenarios(grids[map], name, {}, random())) {
      const double length = scenario.optimal_length;
      if (length < options.min_length || length > options.max_length) continue;
      tasks.push_back({map, scenario.start, scenario.goal, length});
    }
    shuffle(&tasks, random);
    const std::size_t share = (static_cast<std::size_t>(options.validation) + map) / grids.size();
    if (tasks.size() > share) tasks.resize(share);
    set.tasks.insert(set.tasks.end(), tasks.begin(), tasks.end());
    set.map_names.push_back(name + "_" + std::to_string(map));
  }
  set.maps = grids;
  if (set.tasks.empty()) {
    throw std::invalid_argument("generated maps of --map-size " + std::to_string(options.map_size) +
                                " have no path as long as --min-length");
  }
  return set;
}

using Generator = std::function<PassableGrid(std::uint64_t seed)>;

void addGenerated(const std::string& name, const Generator& generate, const GridTrainingOptions& options,
                  GridTrainingMaps* maps) {
  std::vector<PassableGrid> grids(kTrainingMaps + kValidationMaps);
  parallelFor(static_cast<int>(grids.size()), options.threads, [&](int index, int) {
    grids[static_cast<std::size_t>(index)] = generate(options.seed * 1000 + static_cast<std::uint64_t>(index));
  });
  const auto first_validation = grids.begin() + kTrainingMaps;
  maps->training.emplace_back(grids.begin(), first_validation);
  maps->validation.push_back(drawTasks(name, {first_validation, grids.end()}, options));
}

void generate(const GridTrainingOptions& options, GridTrainingMaps* maps) {
  const auto sized = [&](auto parameters) {
    parameters.columns = options.map_size;
    parameters.rows = options.map_size;
    return parameters;
  };
  const auto caves = [&](std::uint64_t seed) { return generateCaves(sized(CaveParameters{}), seed); };
  const auto mazes = [&](std::uint64_t seed) { return generateMaze(sized(MazeParameters{}), seed); };
  const auto fill = [&](std::uint64_t seed) { return generateRandomFill(sized(RandomFillParameters{}), seed); };
  addGenerated("caves", caves, options, maps);
  addGenerated("mazes", mazes, options, maps);
  addGenerated("random-fill", fill, options, maps);
}

}  // namespace

void addGridMapOptions(GridTrainingOptions* options, CommandLine* line) {
  GridTrainingOptions& o = *options;
  line->addChoice("task", &o.task, {"grid", "robot"}, "grid (this) or robot");
  line->addFiles("maps", &o.maps,
                 "folders of the MovingAI benchmark's sets (with Maps and Scenarios in them); "
                 "maps 0-5 of a set (of more than 20 maps the first half) are for training, the others for validation "
                 "(default: generated caves, mazes and random fill)");
  line->add("map-size", &o.map_size, {16, 4096}, "cells; size of the generated maps");
  line->add("min-length", &o.min_length, {2.0, 1e6}, "cells, of the shortest path");
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
  addGridMapOptions(options, line);
  line->add("dead-ends", &o.dead_ends, kAnyShare,
            "share of the training episodes that start in a dead end, where there is one between the start and the "
            "goal: the blind spots of thesis ch. 5");
  line->add("method", &o.method, "imitation, dagger or q-learning");
  addShapeOptions(&o.shape, {64, 64, 64, 64}, line);
  line->addFile("from", &o.from, "ONNX file to start from, instead of random weights; it determines the layers")
      .mayBeReplaced();
  line->addOutput("output", &o.loop.output, "ONNX file to write: the best so far on the validation maps").required();
  line->addOutput("curve", &o.curve, "PNG file for the learning curve; a CSV file is written beside it");
  line->addOutput("checkpoint", &o.loop.checkpoint, "checkpoint file: is written, and continued from if it exists");
  line->add("validation", &o.validation, {1, 1e6}, "scenarios of each set, to judge the network");
  line->whenParsed([options, line] {
    if (!options->from.empty()) checkModelDecides(*line, "--from");
    makeNetwork(kGridInputs, options->shape, kGridMoveCount);  // throws
  });
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
  return initialised(makeNetwork(kGridInputs, options.shape, kGridMoveCount), options.seed);
}

GridTrainingMaps loadGridTrainingMaps(const GridTrainingOptions& options) {
  GridTrainingMaps maps;
  for (const std::string& folder : options.maps) {
    for (const GridSetFiles& files : findGridSets(folder)) addSet(files, options, &maps);
  }
  if (options.maps.empty()) generate(options, &maps);
  return maps;
}

std::vector<GridCourse::Set> validationMaps(const GridTrainingMaps& maps) {
  std::vector<GridCourse::Set> sets;
  for (const GridTaskSet& set : maps.validation) sets.push_back(set.maps);
  return sets;
}

GridTrainingHost::GridTrainingHost(const GridTrainingOptions& options, std::vector<GridTaskSet> sets)
    : ToolTrainingHost(options.loop), options_(options), sets_(std::move(sets)) {}

double GridTrainingHost::judge(const LayerStack& layers) {
  Model model;
  model.layers = layers;
  writeGridMetadata(&model.metadata);
  NetworkGridAgent::Options shield_alone;
  shield_alone.guided = false;
  shield_alone.corner_cutting = options_.corner_cutting;
  const auto make_agent = [&](const PassableGrid&) { return std::make_unique<NetworkGridAgent>(model, shield_alone); };
  GridEvaluationOptions evaluation;
  evaluation.rules.max_steps = options_.max_steps;
  evaluation.rules.corner_cutting = options_.corner_cutting;
  evaluation.threads = options_.threads;
  success_.clear();
  double mean = 0.0;
  for (const GridTaskSet& set : sets_) {
    const auto summary =
        summarizeGridEpisodes(set.name, evaluateGridTasks(set, 0, set.tasks.size(), make_agent, evaluation));
    success_.push_back(summary.share(summary.arrived));
    mean += success_.back() / static_cast<double>(sets_.size());
  }
  return mean;
}

void GridTrainingHost::keep(const LayerStack& layers) {
  Model model;
  model.layers = layers;
  writeGridMetadata(&model.metadata);
  model.metadata["training_command"] = options_.command;
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << "arrival on validation maps with the shield alone, paths of "
       << std::setprecision(0) << options_.min_length << " to " << options_.max_length << " cells in "
       << options_.max_steps << " steps:" << std::setprecision(3);
  for (std::size_t i = 0; i < sets_.size(); ++i) text << ' ' << sets_[i].name << ' ' << success_[i];
  model.metadata["score"] = text.str();
  writeModelFile(options_.loop.output, model);
}

std::string GridTrainingHost::scoreText(double score) const { return "mean arrival " + fixedText(score, 3); }

std::vector<std::string> GridTrainingHost::names() const {
  std::vector<std::string> names;
  for (const GridTaskSet& set : sets_) names.push_back(set.name);
  return names;
}

}  // namespace lstm_planner
