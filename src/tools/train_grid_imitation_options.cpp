#include "tools/train_grid_imitation_options.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "tools/options.hpp"

namespace lstm_planner {

namespace {

/// The optimiser's choices as they are written on the command line.
struct OptimiserNames {
  std::string optimiser;
  std::string decay;
  std::string schedule;
};

template <typename Value>
Value named(const char* option, const std::string& name, const std::vector<std::pair<const char*, Value>>& choices) {
  std::string expected;
  for (const auto& choice : choices) {
    if (name == choice.first) return choice.second;
    expected += (expected.empty() ? "" : ", ") + std::string(choice.first);
  }
  throw std::invalid_argument(std::string(option) + " is '" + name + "', expected one of " + expected);
}

OptimiserNames namesOf(const OptimiserParameters& optimiser) {
  return {optimiser.kind == OptimiserKind::kAdam ? "adam" : "momentum", optimiser.decay == Decay::kL1 ? "l1" : "none",
          optimiser.schedule == LearningRateSchedule::kConstant ? "constant" : "cosine"};
}

void apply(const OptimiserNames& names, OptimiserParameters* optimiser) {
  optimiser->kind = named<OptimiserKind>("--optimiser", names.optimiser,
                                         {{"adam", OptimiserKind::kAdam}, {"momentum", OptimiserKind::kMomentum}});
  optimiser->decay = named<Decay>(
      "--decay", names.decay,
      {{"none", Decay::kNone}, {"l1", Decay::kL1}, {"l2", Decay::kL2Norm}, {"l2-squared", Decay::kL2Squared}});
  optimiser->schedule = named<LearningRateSchedule>(
      "--schedule", names.schedule,
      {{"constant", LearningRateSchedule::kConstant}, {"cosine", LearningRateSchedule::kCosine}});
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
  namespace po = boost::program_options;
  const bool dagger = method == "dagger";
  const bool thesis = std::find(arguments.begin(), arguments.end(), "--thesis") != arguments.end();
  GridImitationParameters& p = *parameters;
  GridDatasetParameters& dataset = p.dataset;
  OptimiserParameters& optimiser = p.trainer.optimiser;
  options->method = method;
  setDefaults(dagger, thesis, options, parameters);
  OptimiserNames names = namesOf(optimiser);
  po::options_description description("a network for the grid world, by imitation of the shortest way");
  addGridTrainingOptions(options, &description);
  // clang-format off
  description.add_options()
      ("thesis", "defaults of the thesis's training, Tables 3.1 and 3.2: its inputs, momentum, L1 decay, 500 epochs")
      ("steps", po::value(&dataset.steps)->default_value(dataset.steps), "to learn from, each round")
      ("validation-steps", po::value(&p.validation_steps)->default_value(p.validation_steps),
       "on the validation maps, to choose the best epoch by")
      ("sequence", po::value(&dataset.sequence_steps)->default_value(dataset.sequence_steps),
       "steps that errors go back at most: the thesis's time sequence")
      ("burn-in", po::value(&dataset.burn_in_steps)->default_value(dataset.burn_in_steps),
       "steps that begin a sequence in the middle of a way and only bring the hidden state up to date")
      ("batch-steps", po::value(&p.batch_steps)->default_value(p.batch_steps), "steps an update")
      ("goals", po::value(&p.course.goals)->default_value(p.course.goals), "of the ways of a round")
      ("optimiser", po::value(&names.optimiser)->default_value(names.optimiser), "adam or momentum")
      ("rate", po::value(&optimiser.learning_rate)->default_value(optimiser.learning_rate), "learning rate")
      ("schedule", po::value(&names.schedule)->default_value(names.schedule), "of the rate: constant or cosine")
      ("momentum", po::value(&optimiser.momentum)->default_value(optimiser.momentum), "rate")
      ("decay", po::value(&names.decay)->default_value(names.decay), "of the weights: none, l1, l2 or l2-squared")
      ("decay-rate", po::value(&optimiser.decay_rate)->default_value(optimiser.decay_rate), "beta");
  if (dagger) description.add_options()
      ("rounds", po::value(&p.rounds)->default_value(p.rounds), "of collecting and training for --epochs")
      ("learner-share", po::value(&p.learner_share)->default_value(p.learner_share),
       "of the ways, led by the network");
  // clang-format on
  po::variables_map values;
  if (!parseOptions("train", description, arguments, &values)) return false;
  finishGridTrainingOptions(values, arguments, options);
  apply(names, &optimiser);
  if (thesis && values["batch-steps"].defaulted()) p.batch_steps = dataset.sequence_steps;
  p.encoder = options->encoder;
  p.trainer.epochs = options->epochs;
  p.course.min_length = options->min_length;
  p.course.max_length = options->max_length;
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
                    {"optimiser", names.optimiser},
                    {"rate", optimiser.learning_rate},
                    {"schedule", names.schedule},
                    {"momentum", optimiser.momentum},
                    {"decay", names.decay},
                    {"decay-rate", optimiser.decay_rate},
                    {"rounds", p.rounds},
                    {"learner-share", p.learner_share}});
  return true;
}

}  // namespace lstm_planner
