#include "tools/train_grid_imitation_options.hpp"

#include <algorithm>

#include "tools/network_options.hpp"
#include "tools/ranges.hpp"

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
  line.add("steps", &dataset.steps, kAnySteps, "number of steps for training, each round");
  line.add("validation-steps", &p.validation_steps, kAnySteps,
           "number of steps on the validation maps, to choose the best epoch");
  line.add("sequence", &dataset.sequence_steps, kAnyWindow,
           "largest number of steps of backpropagation through time: the thesis's time sequence");
  line.add("burn-in", &dataset.burn_in_steps, {0, kAnyWindow.most},
           "if a sequence starts in the middle of a path: steps before it that only set the hidden state");
  line.add("batch-steps", &p.batch_steps, kAnySteps, "steps per update");
  line.add("goals", &p.course.goals, {1, 1e5}, "seed of the paths of a round");
  line.addFlag("corner-cutting", &options->corner_cutting, CornerCutting::kAllowed,
               "diagonal moves may pass blocked cells at their sides");
  line.addChoice("supervisor", &dataset.supervisor, kSupervisors,
                 "paths to learn: shortest, or thesis (A* with 25 times the Euclidean distance)");
  addLossOption(&p.trainer.loss, &line);
  addOptimiserOptions(&optimiser, &line);
  if (dagger) {
    line.add("rounds", &p.rounds, kAnyCount, "rounds of collecting paths and training for --epochs");
    line.add("learner-share", &p.learner_share, kAnyShare, "share of the paths that the network leads");
  }
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
  settings->update({{"steps", dataset.steps},
                    {"validation-steps", p.validation_steps},
                    {"sequence", dataset.sequence_steps},
                    {"burn-in", dataset.burn_in_steps},
                    {"batch-steps", p.batch_steps},
                    {"goals", p.course.goals},
                    {"optimiser", nameOf(optimiser.kind, kOptimisers)},
                    {"rate", optimiser.learning_rate},
                    {"schedule", nameOf(optimiser.schedule, kSchedules)},
                    {"momentum", optimiser.momentum},
                    {"decay", nameOf(optimiser.decay, kDecays)},
                    {"decay-rate", optimiser.decay_rate},
                    {"rounds", p.rounds},
                    {"learner-share", p.learner_share}});
  if (dataset.supervisor != GridSupervisor::kShortestPath) (*settings)["supervisor"] = "thesis";
  if (p.trainer.loss != Loss::kCrossEntropy) (*settings)["loss"] = nameOf(p.trainer.loss, losses());
  return true;
}

}  // namespace lstm_planner
