#include <iomanip>
#include <iostream>

#include "lstm_planner/base/learning/learning_curve.hpp"
#include "lstm_planner/robot/learning/imitation.hpp"
#include "tools/network_options.hpp"
#include "tools/progress.hpp"
#include "tools/ranges.hpp"
#include "tools/ranks.hpp"
#include "tools/train_commands.hpp"
#include "tools/train_robot_options.hpp"

namespace lstm_planner {

namespace {

struct ImitationOptions : RobotTrainingOptions {
  std::string curve;
  RobotNetworkOptions network;
  ImitationParameters imitation;
};

bool readOptions(const std::vector<std::string>& arguments, ImitationOptions* options) {
  ImitationParameters& imitation = options->imitation;
  imitation.trainer.epochs = 12;
  imitation.trainer.optimiser.learning_rate = 0.01;
  CommandLine line("train",
                   "trains a network for the robot by imitation in generated worlds; --method actor-critic --init FILE "
                   "then improves it by reinforcement");
  addRobotTrainingOptions(arguments, options, &line);
  addRobotNetworkOptions(&options->network, &imitation.policy.encoder, &line);
  line.addOutput("curve", &options->curve, "PNG file for the accuracy curve; a CSV file is written beside it");
  line.add("rounds", &imitation.rounds, kAnyCount, "rounds of collecting drives and training");
  line.add("worlds", &imitation.worlds, {1, 1e5}, "worlds per round");
  line.add("goals", &imitation.goals, {1, 1e4}, "goals per world");
  line.add("starts", &imitation.starts, {1, 1e4}, "drives per goal");
  line.add("epochs", &imitation.trainer.epochs, kAnyCount, "epochs per round");
  line.add("rate", &imitation.trainer.optimiser.learning_rate, kAnyRate, "learning rate");
  addLossOption(&imitation.trainer.loss, &line);
  line.add("learner-share", &imitation.learner_share, kAnyShare,
           "share of the drives in which the learning network steers");
  if (!line.parse(arguments)) return false;
  finishRobotNetworkOptions(line, &options->network, &imitation.policy.encoder);
  imitation.shape = options->network.shape;
  imitation.course = options->course;
  imitation.validation_worlds = options->validation;
  imitation.max_steps = options->max_steps;
  imitation.threads = imitation.trainer.threads = options->threads;
  imitation.seed = imitation.trainer.seed = options->seed;
  imitation.trainer.communicator = ranks();
  validate(imitation);
  return true;
}

}  // namespace

int trainRobotByDagger(const std::vector<std::string>& arguments) {
  ImitationOptions options;
  if (!readOptions(arguments, &options)) return 0;
  Progress progress;
  DriveScore best;
  std::cout << std::fixed << std::setprecision(3) << "round    steps  accuracy  arrival alone  efficiency" << std::endl;
  const auto report = [&](const ImitationRound& round) {
    const EpochReport& epoch = round.training.best();
    std::cout << std::setw(5) << round.round << std::setw(9) << round.steps << std::setw(10)
              << epoch.validation.accuracy() << std::setw(15) << round.score.arrival << std::setw(12)
              << round.score.efficiency << std::endl;
    if (round.score.efficiency >= best.efficiency) best = round.score;
  };
  const ImitationResult result = imitate(
      options.imitation, [&](double share) { progress.show(share); }, report);
  progress.show(1.0);
  if (!isFirstRank()) return 0;
  writeRobotModel(options, options.imitation.policy, result.layers, best);
  std::cout << "wrote " << options.output << ": " << toText(best) << "\n";
  if (!options.curve.empty()) {
    const std::string stem = options.curve.substr(0, options.curve.rfind('.'));
    writeLearningCurve(stem + ".csv", options.curve, result.curve);
  }
  return 0;
}

}  // namespace lstm_planner
