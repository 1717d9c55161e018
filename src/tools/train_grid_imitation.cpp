#include <iomanip>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/common/words.hpp"
#include "lstm_planner/grid_world/learning/grid_imitation.hpp"
#include "lstm_planner/training/learning_curve.hpp"
#include "tools/command.hpp"
#include "tools/command_line.hpp"
#include "tools/train_grid.hpp"
#include "tools/training.hpp"

namespace lstm_planner {
namespace {

const Choices<OptimiserKind> kOptimisers = {
    {"adam", OptimiserKind::kAdam}, {"momentum", OptimiserKind::kMomentum}, {"adadelta", OptimiserKind::kAdaDelta}};
const Choices<GridSupervisor> kSupervisors = {{"shortest", GridSupervisor::kShortestPath},
                                              {"thesis", GridSupervisor::kThesisAStar}};

void addOptimiserOptions(OptimiserParameters* optimiser, CommandLine* line) {
  line->addChoice("optimiser", &optimiser->kind, kOptimisers, "adam, momentum or adadelta");
  line->add("rate", &optimiser->learning_rate, kAnyRate, "learning rate");
  line->add("momentum", &optimiser->momentum, kAnyShare, "momentum; of adadelta the decay of its means");
}

/// Defaults of the method, or of the thesis.
void setDefaults(bool dagger, bool thesis, GridTrainingOptions* options, GridImitationParameters* parameters) {
  if (thesis) {
    *parameters = thesisImitation();
  } else {
    parameters->trainer.epochs = dagger ? 12 : 40;
    parameters->trainer.optimiser.learning_rate = 0.01;
  }
  parameters->rounds = dagger ? 10 : 1;
  options->epochs = parameters->trainer.epochs;
}

/// Parses the options of --method imitation and dagger. False when the help was asked for. Throws with a sentence for
/// values that make no sense.
bool readImitationOptions(const std::string& method, const std::vector<std::string>& arguments,
                          GridTrainingOptions* options, GridImitationParameters* parameters) {
  const bool dagger = method == "dagger";
  const bool thesis = contains(arguments, "--thesis");
  GridImitationParameters& p = *parameters;
  GridDatasetParameters& dataset = p.dataset;
  OptimiserParameters& optimiser = p.trainer.optimiser;
  options->method = method;
  setDefaults(dagger, thesis, options, parameters);
  bool known = false;
  CommandLine line("train --task grid --method " + method,
                   "trains a network for the grid world by imitation of the shortest path");
  addGridTrainingOptions(arguments, options, &line);
  line.addFlag("thesis", &known, true,
               "use the thesis's training as defaults (Tables 3.1 and 3.2): momentum, L1 decay, 500 epochs");
  visitGridImitationParameters(p, line.everyParameter());
  line.addFlag("corner-cutting", &options->corner_cutting, CornerCutting::kAllowed,
               "diagonal moves may pass blocked cells at their sides");
  line.addChoice("supervisor", &dataset.supervisor, kSupervisors,
                 "paths to learn: shortest, or thesis (A* with 25 times the Euclidean distance)");
  addLossOption(&p.trainer.loss, &line);
  addOptimiserOptions(&optimiser, &line);
  if (dagger) line.add("rounds", &p.rounds, kAnyCount, "rounds of collecting paths and training for --epochs");
  if (!line.parse(arguments)) return false;
  if (thesis && !line.given("batch-steps")) p.batch_steps = dataset.sequence_steps;
  p.trainer.epochs = options->epochs;
  takeOver(*options, &p);
  validate(p);
  options->loop.settings = line.settings();
  return true;
}

/// Lines printed a round, at most, besides its last.
constexpr int kLinesARound = 20;

class GridImitationHost : public GridTrainingHost {
 public:
  GridImitationHost(const GridTrainingOptions& options, std::vector<GridTaskSet> sets, int epochs,
                    const ImitationRounds& training)
      : GridTrainingHost(options, std::move(sets)), epochs_(epochs), training_(training) {}

  void stepDone() override {
    const EpochReport& report = training_.epoch();
    const int interval = (epochs_ + kLinesARound - 1) / kLinesARound;
    if (report.epoch % interval == 0 || report.epoch == epochs_) {
      std::cout << table_.line({std::to_string(training_.round()), std::to_string(report.epoch),
                                fixedText(report.training.accuracy(), 4), fixedText(report.validation.accuracy(), 4)})
                << std::endl;
    }
    ToolTrainingHost::stepDone();
  }
  void judged(const Judgement& judgement) override {
    std::cout << "round " << training_.round() << ", " << training_.collectedSteps() << " steps, best epoch "
              << training_.roundResult().best_epoch << ": arrival with the shield alone" << std::fixed
              << std::setprecision(3);
    const std::vector<std::string> sets = names();
    for (std::size_t i = 0; i < sets.size(); ++i) std::cout << ' ' << sets[i] << ' ' << success()[i];
    std::cout << ", mean " << judgement.score << (judgement.best ? " (best)" : "") << std::endl;
  }

 private:
  double progress() const override { return training_.progress(); }
  std::string position() const override { return positionOf(training_); }
  void printHeader() const override { std::cout << table_.headings() << std::endl; }

  const TextTable table_{"round  epoch  training accuracy  validation accuracy"};
  int epochs_;  ///< of a round
  const ImitationRounds& training_;
};

int trainByImitation(const std::string& method, const std::vector<std::string>& arguments) {
  GridTrainingOptions options;
  GridImitationParameters parameters;
  if (!readImitationOptions(method, arguments, &options, &parameters)) return 0;
  const LayerStack layers = firstLayers(options);
  const GridTrainingMaps maps = loadGridTrainingMaps(options);
  const auto training = gridImitation(parameters, layers, maps.training, validationMaps(maps));
  GridImitationHost host(options, maps.validation, parameters.trainer.epochs, *training);
  const TrainingOutcome outcome = runTraining(options.loop, training.get(), &host);
  if (!options.curve.empty()) writeLearningCurve(options.curve, training->curve());
  return host.end(outcome);
}

}  // namespace

int trainGridByImitation(const std::vector<std::string>& arguments) { return trainByImitation("imitation", arguments); }

int trainGridByDagger(const std::vector<std::string>& arguments) { return trainByImitation("dagger", arguments); }

}  // namespace lstm_planner
