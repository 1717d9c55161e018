#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "lstm_planner/common/text_table.hpp"
#include "lstm_planner/practice/drive_actor_critic.hpp"
#include "lstm_planner/practice/recorded_choices.hpp"
#include "lstm_planner/training/confusion.hpp"
#include "tools/command.hpp"
#include "tools/train_robot.hpp"
#include "tools/training.hpp"

namespace lstm_planner {
namespace {

/// What is to be trained, and how.
struct RobotReinforcementPlan {
  RobotTrainingOptions options;
  RobotNetworkOptions network;
  std::string init;  ///< model to start with; empty: a new network
  DriveActorCriticParameters learner;
  std::vector<std::string> recordings;  ///< somebody's drives that the network is to follow
  std::vector<std::string> validation;  ///< likewise, to judge it
  double recordings_weight = 0.3;
};

void addOptions(const std::vector<std::string>& arguments, RobotReinforcementPlan* plan, CommandLine* line) {
  DriveActorCriticParameters& p = plan->learner;
  addRobotTrainingOptions(arguments, &plan->options, line);
  line->addFile("init", &plan->init, "model file to start from; it determines layers and inputs").mayBeReplaced();
  line->addChoice("keep", &plan->options.loop.keep_last, {{"best", false}, {"last", true}},
                  "which network to write: best (the most efficient of the networks judged so far) or last")
      .changesNoResult();
  visitPracticeParameters(p, line->everyParameter());
  addRobotNetworkOptions(&plan->network, &p.policy.encoder, line);
  line->addFiles("recordings", &plan->recordings,
                 "datasets of recorded drives: the network also learns to steer as their driver does");
  line->add("recordings-weight", &plan->recordings_weight, {1e-6, 1e6},
            "weight of a recorded step; a practised step has the weight 1");
  line->addFiles("validation-recordings", &plan->validation, "recorded drives for validation").changesNoResult();
  visitActorCriticParameters(p, line->everyParameter());
}

/// False when the help was asked for. Throws std::invalid_argument with a sentence for values that make no sense.
bool readPlan(const std::vector<std::string>& arguments, RobotReinforcementPlan* plan) {
  DriveActorCriticParameters& p = plan->learner;
  CommandLine line("train --method actor-critic",
                   "trains a network for the robot by reinforcement: one that already drives (--init), or a new one");
  addOptions(arguments, plan, &line);
  line.whenParsed([&] {
    if (plan->init.empty()) {
      finishRobotNetworkOptions(plan->network, &p.policy.encoder);
    } else {
      checkModelDecides(line);
    }
  });
  if (!line.parse(arguments)) return false;
  if (plan->init.empty() && !line.given("sharpness")) p.sharpness = 1.0;  // there is nothing to sharpen yet
  p.course = plan->options.course;
  p.max_steps = plan->options.max_steps;
  p.seed = plan->options.seed;
  p.threads = plan->options.threads;
  plan->options.loop.settings = line.settings();
  return true;
}

class RobotReinforcementHost : public ToolTrainingHost {
 public:
  RobotReinforcementHost(const RobotReinforcementPlan& plan, const DriveActorCritic& training)
      : ToolTrainingHost(plan.options.loop),
        options_(plan.options),
        policy_(plan.learner.policy),
        iterations_(plan.learner.iterations),
        training_(training),
        is_validated_(!plan.validation.empty()) {
    if (is_validated_) validation_ = readDatasetsFor(policy_, plan.validation);
  }

  void stepDone() override {
    const ReinforcementReport& report = training_.report();
    std::cout << table_.line({std::to_string(report.update), fixedText(report.steps, 0), fixedText(report.reward, 3),
                              fixedText(report.arrival, 3), fixedText(report.entropy, 3),
                              fixedText(report.explained, 3)})
              << std::endl;
    ToolTrainingHost::stepDone();
  }
  double judge(const LayerStack& layers) override {
    score_ = judgeDrives(DrivePolicy(policy_, layers), options_.course, options_.validation, options_.max_steps,
                         options_.seed, options_.threads);
    return score_.efficiency;
  }
  void keep(const LayerStack& layers) override { writeRobotModel(options_, policy_, layers, score_); }
  void judged(const Judgement& judgement) override {
    std::cout << std::string(table_.headings().size() + 1, ' ') << "| " << toText(score_)
              << (judgement.best ? " (best)" : "") << (is_validated_ ? agreement() : "") << std::endl;
  }

 private:
  /// How often the network would have done what the drivers of the recordings did.
  std::string agreement() const {
    const ConfusionMatrix taken = preferencesIn(validation_, DrivePolicy(policy_, training_.layers()));
    return "; recordings: " + accuracyText(taken) +
           " (majority-class baseline: " + accuracyText(constantAnswer(taken)) + ")";
  }
  double progress() const override { return static_cast<double>(training_.iterations()) / iterations_; }
  std::string position() const override { return "iteration " + std::to_string(training_.iterations()); }
  std::string scoreText(double score) const override { return "efficiency " + fixedText(score, 3); }
  void printHeader() const override { std::cout << table_.headings() << " | validation drives" << std::endl; }

  const TextTable table_{"iteration     steps  reward  arrival  entropy  explained"};
  const RobotTrainingOptions& options_;
  const PolicyDescription& policy_;
  const int iterations_;
  const DriveActorCritic& training_;
  const bool is_validated_;
  Dataset validation_;
  DriveScore score_;  ///< what was judged last
};

}  // namespace

int trainRobotByActorCritic(const std::vector<std::string>& arguments) {
  RobotReinforcementPlan plan;
  if (!readPlan(arguments, &plan)) return 0;
  LayerStack layers = firstLayers(plan.init, plan.network.shape, plan.options.seed, &plan.learner.policy);
  const auto training = makeDriveActorCritic(plan.learner, std::move(layers));
  if (!plan.recordings.empty()) {
    training->follow(readDatasetsFor(plan.learner.policy, plan.recordings), plan.recordings_weight);
  }
  RobotReinforcementHost host(plan, *training);
  return host.end(runTraining(plan.options.loop, training.get(), &host));
}

}  // namespace lstm_planner
