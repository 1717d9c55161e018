#include <iostream>
#include <nlohmann/json.hpp>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/practice/imitation.hpp"
#include "lstm_planner/training/learning_curve.hpp"
#include "tools/command.hpp"
#include "tools/train_robot.hpp"
#include "tools/training.hpp"

namespace lstm_planner {

namespace {

struct ImitationOptions : RobotTrainingOptions {
  std::string curve;
  RobotNetworkOptions network;
  ImitationParameters imitation;
};

bool readOptions(const std::vector<std::string>& arguments, ImitationOptions* options) {
  ImitationParameters& imitation = options->imitation;
  options->method = "dagger";
  options->loop.keep_later = true;  // it has learned from more
  imitation.trainer.epochs = 12;
  imitation.trainer.optimiser.learning_rate = 0.01;
  CommandLine line("train --method dagger",
                   "trains a network for the robot by imitation in generated worlds; --method actor-critic --init FILE "
                   "then improves it by reinforcement");
  addRobotTrainingOptions(arguments, options, &line);
  addRobotNetworkOptions(&options->network, &imitation.policy.encoder, &line);
  line.addOutput("curve", &options->curve, "PNG file for the accuracy curve; a CSV file is written beside it");
  visitImitationParameters(imitation, line.everyParameter());
  addLossOption(&imitation.trainer.loss, &line);
  if (!line.parse(arguments)) return false;
  finishRobotNetworkOptions(options->network, &imitation.policy.encoder);
  imitation.shape = options->network.shape;
  imitation.course = options->course;
  imitation.validation_worlds = options->validation;
  imitation.max_steps = options->max_steps;
  imitation.threads = imitation.trainer.threads = options->threads;
  imitation.seed = imitation.trainer.seed = options->seed;
  validate(imitation);
  options->loop.settings = line.settings();
  return true;
}

class ImitationHost : public ToolTrainingHost {
 public:
  explicit ImitationHost(const ImitationOptions& options)
      : ToolTrainingHost(options.loop),
        options_(options),
        training_(options.imitation, [this](double share) { showProgress(share); }) {}

  DriveImitation& training() { return training_; }

  double judge(const LayerStack& layers) override {
    score_ = training_.judge(layers);
    return score_.efficiency;
  }
  void keep(const LayerStack& layers) override {
    kept_ = score_;
    writeRobotModel(options_, options_.imitation.policy, layers, score_);
  }
  void judged(const Judgement& /*judgement*/) override {
    const EpochReport epoch = training_.roundResult().best();
    std::cout << table_.line({std::to_string(training_.round()), std::to_string(training_.drivenSteps()),
                              fixedText(epoch.validation.accuracy(), 3), fixedText(score_.arrival, 3),
                              fixedText(score_.efficiency, 3)})
              << std::endl;
    showProgress(progress());
  }

  nlohmann::json notes() const override { return {{"kept", {kept_.arrival, kept_.efficiency}}}; }
  void restoreNotes(const nlohmann::json& progress) override {
    kept_.arrival = progress.at("kept").at(0);
    kept_.efficiency = progress.at("kept").at(1);
  }

 private:
  double progress() const override { return training_.drivenShare(); }
  std::string position() const override { return positionOf(training_); }
  std::string scoreText(double /*score*/) const override { return toText(kept_); }
  void printHeader() const override { std::cout << table_.headings() << std::endl; }

  const TextTable table_{"round    steps  accuracy  arrival alone  efficiency"};
  const ImitationOptions& options_;
  DriveImitation training_;
  DriveScore score_;  ///< what was judged last
  DriveScore kept_;   ///< of the network in the output file
};

}  // namespace

int trainRobotByDagger(const std::vector<std::string>& arguments) {
  ImitationOptions options;
  if (!readOptions(arguments, &options)) return 0;
  ImitationHost host(options);
  const TrainingOutcome outcome = runTraining(options.loop, &host.training(), &host);
  if (!options.curve.empty()) writeLearningCurve(options.curve, host.training().curve());
  return host.end(outcome);
}

}  // namespace lstm_planner
