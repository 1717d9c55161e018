#include <iostream>
#include <sstream>

#include "lstm_planner/grid_world/learning/grid_structure_search.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/output_file.hpp"
#include "tools/progress.hpp"
#include "tools/train_grid.hpp"

namespace lstm_planner {

namespace {

/// Of 102,400 steps and 500 epochs (thesis Tables 3.1 and 3.2), so that a search takes minutes.
constexpr int kEpochs = 40;

struct SearchOptions {
  GridTrainingOptions grid;
  GridImitationParameters imitation = thesisImitation();
  std::string output = "structure_search";
};

bool readOptions(const std::vector<std::string>& arguments, SearchOptions* options) {
  GridImitationParameters& imitation = options->imitation;
  GridDatasetParameters& dataset = imitation.dataset;
  options->grid.epochs = kEpochs;
  bool search = true;
  CommandLine line(
      "train --search",
      "trains the structures of the thesis's Tables 3.3 to 3.5, each as in Tables 3.1 and 3.2 except for the epochs");
  line.addFlag("search", &search, true, "this");
  addGridMapOptions(&options->grid, &line);
  line.add("steps", &dataset.steps, kAnySteps, "number of steps for training");
  line.add("validation-steps", &imitation.validation_steps, kAnySteps,
           "number of steps on the validation maps, to judge by");
  line.add("goals", &imitation.course.goals, {1, 1e5}, "number of goals of the paths");
  line.add("rate", &imitation.trainer.optimiser.learning_rate, kAnyRate, "learning rate");
  line.addFile("output", &options->output, "path without extension; .md and .csv are added");
  if (!line.parse(arguments)) return false;
  options->grid.command = trainCommandLine(arguments);
  imitation.trainer.epochs = options->grid.epochs;
  takeOver(options->grid, &imitation);
  validate(imitation);
  checkWithoutExtension(options->output, {".md", ".csv"});
  return true;
}

std::string report(const SearchOptions& options, const GridTrainingMaps& maps,
                   const std::vector<StructureOutcome>& outcomes) {
  const GridImitationParameters& imitation = options.imitation;
  std::ostringstream text;
  text << "# Structure search\n\nHere: " << imitation.dataset.steps << " steps, " << imitation.trainer.epochs
       << " epochs, validation on " << imitation.validation_steps << " steps of other maps of the sets";
  for (const GridTaskSet& set : maps.validation) text << ' ' << set.name;
  text << "; paths of " << options.grid.min_length << " to " << options.grid.max_length
       << " cells without corner cutting, seed " << options.grid.seed << ".\n"
       << "The thesis: 102,400 steps, 500 epochs, validation on 10,240 steps; mazes of corridor width 2 and 4, random "
          "fill of 25 and 40 % (Tables 3.1 and 3.2).\nBoth: momentum 0.95, learning rate "
       << imitation.trainer.optimiser.learning_rate
       << " (the thesis's: 0.1), L1 decay 1e-5, an update a time sequence. "
          "Here the hidden state starts anew with every path, and gradients longer than 1 are shortened."
       << "\n\n    " << options.grid.command << "\n\n"
       << structureTables(outcomes);
  return text.str();
}

}  // namespace

int searchGridStructures(const std::vector<std::string>& arguments) {
  SearchOptions options;
  if (!readOptions(arguments, &options)) return 0;
  const Interruption interruption;
  const GridTrainingMaps maps = loadGridTrainingMaps(options.grid);
  Progress bar;
  const auto progress = [&](double share) {
    bar.show(share);
    return !interruption.wanted();
  };
  const std::vector<StructureOutcome> outcomes =
      searchGridStructures(options.imitation, thesisTrials(), maps.training, validationMaps(maps), progress);
  if (outcomes.empty()) {
    std::cout << "interrupted: no structure is done, nothing is written" << std::endl;
    return interruption.exitStatus();
  }
  const std::string text = report(options, maps, outcomes);
  std::cout << text;
  writeTextFile(options.output + ".md", text);
  writeTextFile(options.output + ".csv", structureCsv(outcomes));
  std::cout << "\nwrote " << options.output << ".md and .csv" << std::endl;
  if (!interruption.wanted()) return 0;
  std::cout << "interrupted: " << outcomes.size() << " structures of " << thesisTrials().size() << " are done"
            << std::endl;
  return interruption.exitStatus();
}

}  // namespace lstm_planner
