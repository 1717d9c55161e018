#include <iomanip>
#include <iostream>
#include <sstream>

#include "lstm_planner/learning/imitation.hpp"
#include "lstm_planner/learning/learning_curve.hpp"
#include "lstm_planner/network/model_file.hpp"
#include "tools/options.hpp"
#include "tools/progress.hpp"
#include "tools/ranks.hpp"
#include "tools/train_commands.hpp"

namespace lstm_planner {

namespace {

struct TrainOptions {
  std::string output = "models/create2_lstm_2x8.onnx";
  std::string curve;
  ImitationParameters imitation;
};

bool readOptions(const std::vector<std::string>& arguments, TrainOptions* options) {
  namespace po = boost::program_options;
  ImitationParameters& imitation = options->imitation;
  imitation.trainer.epochs = 12;
  imitation.trainer.optimiser.learning_rate = 0.01;
  std::string task;
  po::options_description description(
      "by imitation in generated floor plans; --task grid --help explains the grid world");
  // clang-format off
  description.add_options()
      ("task", po::value(&task)->default_value("robot"), "robot (this) or grid")
      ("output", po::value(&options->output)->default_value(options->output), "ONNX file to write")
      ("curve", po::value(&options->curve), "PNG file for the accuracy curve; a CSV file is written beside it")
      ("cells", po::value(&imitation.cells)->multitoken(), "memory cells of each LSTM layer (default: 8 8)")
      ("rounds", po::value(&imitation.rounds)->default_value(imitation.rounds), "of collecting and training")
      ("plans", po::value(&imitation.plans)->default_value(imitation.plans), "floor plans a round")
      ("episodes", po::value(&imitation.episodes)->default_value(imitation.episodes), "drives a floor plan")
      ("validation-plans", po::value(&imitation.validation_plans)->default_value(imitation.validation_plans),
       "floor plans that are never trained on")
      ("epochs", po::value(&imitation.trainer.epochs)->default_value(imitation.trainer.epochs), "a round")
      ("rate", po::value(&imitation.trainer.optimiser.learning_rate)
                   ->default_value(imitation.trainer.optimiser.learning_rate), "learning rate")
      ("learner-share", po::value(&imitation.learner_share)->default_value(imitation.learner_share),
       "share of drives with the learner at the wheel")
      ("seed", po::value(&imitation.seed)->default_value(imitation.seed), "of everything")
      ("threads", po::value(&imitation.threads)->default_value(imitation.threads), "does not change the result");
  // clang-format on
  po::variables_map values;
  if (!parseOptions("train", description, arguments, &values)) {
    return false;
  }
  imitation.trainer.threads = imitation.threads;
  imitation.trainer.seed = imitation.seed;
  return true;
}

std::vector<EpochReport> wholeCurve(const ImitationResult& result) {
  std::vector<EpochReport> curve;
  for (const ImitationRound& round : result.rounds) {
    for (EpochReport report : round.training.curve) {
      report.epoch = static_cast<int>(curve.size()) + 1;
      curve.push_back(std::move(report));
    }
  }
  return curve;
}

}  // namespace

int trainRobot(const std::vector<std::string>& arguments) {
  TrainOptions options;
  if (!readOptions(arguments, &options)) {
    return 0;
  }
  options.imitation.trainer.communicator = ranks();
  Progress progress;
  double best_arrival = 0.0;
  double best_accuracy = 0.0;
  std::cout << std::fixed << std::setprecision(3) << "round    steps  accuracy  arrival alone" << std::endl;
  const auto report = [&](const ImitationRound& round) {
    const EpochReport& best = round.training.curve[static_cast<std::size_t>(round.training.best_epoch - 1)];
    const double accuracy = best.validation.accuracy();
    std::cout << std::setw(5) << round.round << std::setw(9) << round.steps << std::setw(10) << accuracy
              << std::setw(15) << round.arrival << std::endl;
    if (round.arrival >= best_arrival) {
      best_arrival = round.arrival;
      best_accuracy = accuracy;
    }
  };
  const ImitationResult result = imitate(
      options.imitation, [&](double share) { progress.show(share); }, report);
  progress.show(1.0);

  Model model;
  model.layers = result.layers;
  writeMetadata(options.imitation.policy, &model.metadata);
  model.metadata["training_command"] = trainCommandLine(arguments);
  std::ostringstream score;
  score << std::fixed << std::setprecision(3) << "validation accuracy " << best_accuracy
        << ", arrival with the shield alone " << best_arrival;
  model.metadata["score"] = score.str();
  if (!isFirstRank()) return 0;
  writeModelFile(options.output, model);
  std::cout << "wrote " << options.output << ": " << score.str() << "\n";
  if (!options.curve.empty()) {
    const std::string stem = options.curve.substr(0, options.curve.rfind('.'));
    writeLearningCurve(stem + ".csv", options.curve, wholeCurve(result));
  }
  return 0;
}

}  // namespace lstm_planner
