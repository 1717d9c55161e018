#include "tools/train_grid_imitation_options.hpp"

#include <algorithm>

#include "tools/network_options.hpp"
#include "tools/ranges.hpp"
#include "tools/visited_settings.hpp"

namespace lstm_planner {

namespace {

const Choices<OptimiserKind> kOptimisers = {
    {"adam", OptimiserKind::kAdam}, {"momentum", OptimiserKind::kMomentum}, {"adadelta", OptimiserKind::kAdaDelta}};
const Choices<Decay> kDecays = {
    {"none", Decay::kNone}, {"l1", Decay::kL1}, {"l2", Decay::kL2Norm}, {"l2-squared", Decay::kL2Squared}};
const Choices<GridSupervisor> kSupervisors = {{"shortest", GridSupervisor::kShortestPath},
                                              {"thesis", GridSupervisor::kThesisAStar}};
const Choices<LearningRateSchedule> kSchedules = {{"constant", LearningRateSchedule::kConstant},
                                                  {"cosine", LearningRateSchedule::kCosine}};

void addOptimiserOptions(OptimiserParameters* optimiser, CommandLine* line) {
  line->addChoice("optimiser", &optimiser->kind, kOptimisers, "adam, momentum or adadelta");
  line->add("rate", &optimiser->learning_rate, kAnyRate, "learning rate");
  line->addChoice("schedule", &optimiser->schedule, kSchedules, "schedule of the rate: constant or cosine");
  line->add("momentum", &optimiser->momentum, kAnyShare, "momentum; of adadelta the decay of its means");
  line->addChoice("decay", &optimiser->decay, kDecays, "decay of the weights: none, l1, l2 or l2-squared");
  line->add("decay-rate", &optimiser->decay_rate, kAnyWeight, "beta");
}

/// Defaults of the method, or of the thesis.
void setDefaults(bool dagger, bool thesis, GridTrainingOptions* options, GridImitationParameters* parameters) {
  if (thesis) {
    *parameters = thesisImitation();
    options->inputs = "thesis";
  } else {
    parameters->trainer.epochs = dagger ? 12 : 40;
    parameters->trainer.optimiser.learning_rate = 0.01;
  }
  parameters->rounds = dagger ? 10 : 1;
  options->encoder = parameters->encoder;
  options->epochs = parameters->trainer.epochs;
}

}  // namespace

bool readImitationOptions(const std::string& method, const std::vector<std::string>& arguments,
                          GridTrainingOptions* options, GridImitationParameters* parameters, nlohmann::json* settings) {
  const bool dagger = method == "dagger";
  const bool thesis = std::find(arguments.begin(), arguments.end(), "--thesis") != arguments.end();
  GridImitationParameters& p = *parameters;
  GridDatasetParameters& dataset = p.dataset;
  OptimiserParameters& optimiser = p.trainer.optimiser;
  options->method = method;
  setDefaults(dagger, thesis, options, parameters);
  bool known = false;
  CommandLine line("train --task grid --method " + method,
                   "trains a network for the grid world by imitation of the shortest path");
  addGridTrainingOptions(arguments, options, &line);
  line.addFlag(
      "thesis", &known, true,
      "use the thesis's training as defaults (Tables 3.1 and 3.2): its inputs, momentum, L1 decay, 500 epochs");
  visitGridImitationParameters(p, line.everyParameter());
  line.addFlag("corner-cutting", &options->corner_cutting, CornerCutting::kAllowed,
               "diagonal moves may pass blocked cells at their sides");
  line.addChoice("supervisor", &dataset.supervisor, kSupervisors,
                 "paths to learn: shortest, or thesis (A* with 25 times the Euclidean distance)");
  addLossOption(&p.trainer.loss, &line);
  addOptimiserOptions(&optimiser, &line);
  if (dagger) visitGridRoundParameters(p, line.everyParameter());
  if (!line.parse(arguments)) return false;
  if (thesis && !line.given("batch-steps")) p.batch_steps = dataset.sequence_steps;
  p.encoder = options->encoder;
  p.trainer.epochs = options->epochs;
  p.course.min_length = options->min_length;
  p.course.max_length = options->max_length;
  p.course.dead_end_share = options->dead_ends;
  p.course.corner_cutting = options->corner_cutting;
  p.seed = options->seed;
  p.threads = options->threads;
  validate(p);
  *settings = settingsOf(*options);
  visitGridImitationParameters(p, noteIn(settings));
  visitGridRoundParameters(p, noteIn(settings));
  settings->update({{"optimiser", nameOf(optimiser.kind, kOptimisers)},
                    {"rate", optimiser.learning_rate},
                    {"schedule", nameOf(optimiser.schedule, kSchedules)},
                    {"momentum", optimiser.momentum},
                    {"decay", nameOf(optimiser.decay, kDecays)},
                    {"decay-rate", optimiser.decay_rate}});
  if (dataset.supervisor != GridSupervisor::kShortestPath) (*settings)["supervisor"] = "thesis";
  if (p.trainer.loss != Loss::kCrossEntropy) (*settings)["loss"] = nameOf(p.trainer.loss, losses());
  return true;
}

}  // namespace lstm_planner
