#include "tools/train_robot_dataset_options.hpp"

#include <sstream>
#include <stdexcept>

#include "tools/options.hpp"
#include "tools/output_file.hpp"
#include "tools/ranks.hpp"
#include "tools/train_commands.hpp"

namespace lstm_planner {

namespace po = boost::program_options;

namespace {

/// An option whose default is the value that is there.
template <typename T>
auto withDefault(T* value) {
  std::ostringstream text;  // boost's own would be 0.10000000000000001
  text << *value;
  return po::value(value)->default_value(*value, text.str());
}

/// The options on which the defaults of the others depend.
void readPreset(const std::vector<std::string>& arguments, DatasetTrainingOptions* options) {
  po::options_description description;
  description.add_options()("preset", po::value(&options->preset))("init", po::value(&options->init));
  const auto style = po::command_line_style::default_style & ~po::command_line_style::allow_guessing;
  po::variables_map values;
  po::store(po::command_line_parser(arguments).options(description).style(style).allow_unregistered().run(), values);
  po::notify(values);
  if (options->preset == "thesis") {
    options->training = thesisDatasetTraining();
  } else if (options->preset == "stable") {
    options->training = options->fromModel() ? fineTuning() : stableDatasetTraining();
  } else {
    throw std::invalid_argument("--preset is '" + options->preset + "', expected thesis or stable");
  }
}

void addDataOptions(DatasetTrainingOptions* o, po::options_description* all) {
  DatasetSequenceParameters& sequences = o->training.sequences;
  po::options_description description("what is learned from");
  // clang-format off
  description.add_options()
      ("dataset", po::value(&o->datasets)->multitoken()->required(), "recorded drives, one file or more")
      ("validation-dataset", po::value(&o->validation_datasets)->multitoken(), "drives that judge what was learned")
      ("validation-share", withDefault(&o->validation_share), "of the steps, in whole episodes, without such a file")
      ("label-distance", withDefault(&sequences.label_distance),
       "m; a label is the way to where the driver was so far on; 0: to the next step, as recorded")
      ("sequence", withDefault(&sequences.sequence_steps), "steps learned at once; 0: whole episodes")
      ("burn-in", withDefault(&sequences.burn_in_steps), "steps before them that only bring the memory up to date")
      ("balance", po::value<std::string>()->default_value(toString(o->training.balance)),
       "weight of rare labels: none, sqrt or inverse")
      ("variants", withDefault(&o->training.variants),
       "of each drive that are learned from, too: with another first heading, and every other one mirrored");
  // clang-format on
  all->add(description);
}

void addNetworkOptions(DatasetTrainingOptions* o, po::options_description* all) {
  po::options_description description("the network");
  // clang-format off
  description.add_options()
      ("init", po::value(&o->init), "model file to begin with; decides inputs and shape")
      ("output", po::value(&o->output)->required(), "ONNX file to write");
  // clang-format on
  addRobotNetworkOptions(&o->network, &o->encoder, &description);
  all->add(description);
}

void addTrainingOptions(DatasetTrainingOptions* o, po::options_description* all) {
  TrainerParameters& trainer = o->training.trainer;
  po::options_description description("how");
  // clang-format off
  description.add_options()
      ("task", po::value<std::string>()->default_value("robot"), "robot")
      ("method", po::value<std::string>(), "dataset; --dataset says it, too")
      ("preset", withDefault(&o->preset), "stable, or thesis: table 4.2; decides the defaults")
      ("epochs", withDefault(&trainer.epochs), "passes over the training set")
      ("rate", withDefault(&trainer.optimiser.learning_rate), "learning rate")
      ("batch", withDefault(&trainer.batch_size), "sequences an update")
      ("clip", withDefault(&trainer.optimiser.max_gradient_norm), "longer gradients are shortened; 0: never")
      ("averaging", withDefault(&trainer.averaging), "share of the averaged weights that an update leaves; 0: none")
      ("seed", withDefault(&o->seed), "of everything")
      ("threads", withDefault(&trainer.threads), "does not change the result");
  // clang-format on
  all->add(description);
}

void addPictureOptions(DatasetTrainingOptions* o, po::options_description* all) {
  po::options_description description("pictures (PNG); a CSV file is written beside each");
  // clang-format off
  description.add_options()
      ("curve", po::value(&o->curve), "accuracy and loss by epoch")
      ("confusion", po::value(&o->confusion), "labels and answers")
      ("instability", po::value(&o->stability), "thesis figure 4.10: what an epoch's accuracy can mean");
  // clang-format on
  all->add(description);
}

void check(const po::variables_map& values, const DatasetTrainingOptions& o) {
  if (values["task"].as<std::string>() != "robot") {
    throw std::invalid_argument("--dataset trains the robot, --task is '" + values["task"].as<std::string>() + "'");
  }
  if (values.count("method") > 0 && values["method"].as<std::string>() != "dataset") {
    throw std::invalid_argument("--dataset and --method " + values["method"].as<std::string>() + " exclude each other");
  }
  if (o.fromModel()) checkModelDecides(values);
  if (!o.validation_datasets.empty() && !values["validation-share"].defaulted()) {
    throw std::invalid_argument("--validation-dataset and --validation-share exclude each other");
  }
  if (!o.stability.empty() && o.training.trainer.averaging <= 0.0) {
    throw std::invalid_argument("--instability compares with averaged weights, --averaging is 0");
  }
  for (const std::string& file : {o.output, o.curve, o.confusion, o.stability}) {
    if (!file.empty()) checkWritable(file);
  }
}

}  // namespace

bool readDatasetTrainingOptions(const std::vector<std::string>& arguments, DatasetTrainingOptions* options) {
  readPreset(arguments, options);
  po::options_description description("the robot, from recorded drives");
  addDataOptions(options, &description);
  addNetworkOptions(options, &description);
  addTrainingOptions(options, &description);
  addPictureOptions(options, &description);
  po::variables_map values;
  if (!parseOptions("train", description, arguments, &values)) return false;
  options->command = trainCommandLine(arguments);
  options->training.balance = labelBalanceNamed(values["balance"].as<std::string>());
  options->training.trainer.seed = options->seed;
  options->training.trainer.communicator = ranks();
  validate(options->training);
  check(values, *options);
  if (!options->fromModel()) finishRobotNetworkOptions(values, &options->network, &options->encoder);
  return true;
}

}  // namespace lstm_planner
