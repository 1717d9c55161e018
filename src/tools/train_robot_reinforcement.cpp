#include "tools/train_robot_reinforcement.hpp"

#include <iostream>
#include <utility>

#include "tools/training_host.hpp"

namespace lstm_planner {

namespace {

/// Times that the network is judged in a whole training, but for the first.
constexpr int kJudgements = 10;

class RobotReinforcementHost : public ToolTrainingHost {
 public:
  RobotReinforcementHost(const TrainingLoopOptions& loop, const RobotReinforcementPlan& plan,
                         const PolicyDescription& policy, const RobotLearningTable& table,
                         const DriveReinforcement& training)
      : ToolTrainingHost(loop), options_(plan.options), policy_(policy), table_(table), training_(training) {}

  void stepDone() override {
    std::cout << table_.table.line(table_.cells(training_.report())) << std::endl;
    ToolTrainingHost::stepDone();
  }
  double judge(const LayerStack& layers) override {
    score_ = judgeDrives(DrivePolicy(policy_, layers), options_.course, options_.validation, options_.max_steps,
                         options_.seed, options_.threads);
    return score_.efficiency;
  }
  void keep(const LayerStack& layers) override { writeRobotModel(options_, policy_, layers, score_); }
  void judged(const Judgement& judgement) override {
    std::cout << std::string(table_.table.headings().size() + 1, ' ') << "| " << toText(score_)
              << (judgement.best ? " (best)" : "") << table_.remark(training_.layers()) << std::endl;
  }

 private:
  double progress() const override { return training_.progress(); }
  std::string position() const override { return "iteration " + std::to_string(training_.iterations()); }
  std::string scoreText(double score) const override { return namedScore("efficiency", score); }
  void printHeader() const override { std::cout << table_.table.headings() << " | validation drives" << std::endl; }

  const RobotTrainingOptions& options_;
  const PolicyDescription& policy_;
  const RobotLearningTable& table_;
  const DriveReinforcement& training_;
  DriveScore score_;  ///< what was judged last
};

}  // namespace

void finishRobotNetwork(const CommandLine& line, RobotReinforcementPlan* plan, EncoderParameters* encoder) {
  if (plan->init.empty()) {
    finishRobotNetworkOptions(line, &plan->network, encoder);
  } else {
    checkModelDecides(line);
  }
}

nlohmann::json changedSettingsOf(const RobotNetworkOptions& network, const EncoderParameters& encoder) {
  const nlohmann::json defaults = settingsOf(RobotNetworkOptions(), EncoderParameters());
  nlohmann::json settings = settingsOf(network, encoder);
  for (const char* name : {"event-range", "position-cell", "heading-cell", "activation", "candidate"}) {
    if (settings[name] == defaults[name]) settings.erase(name);
  }
  return settings;
}

LayerStack firstLayers(const RobotReinforcementPlan& plan, PolicyDescription* policy) {
  if (!plan.init.empty()) {
    Model model = readModelFile(plan.init);
    *policy = readPolicyDescription(model.metadata);
    return std::move(model.layers);
  }
  const int inputs = static_cast<int>(policy->encoder.input_layout.size());
  LayerStack layers = makeNetwork(inputs, plan.network.shape, networkOutputs(*policy));
  initialise({}, plan.options.seed, layers);
  return layers;
}

int trainByReinforcement(const RobotReinforcementPlan& plan, const PolicyDescription& policy, int iterations,
                         const RobotLearningTable& table, DriveLearner* learner) {
  TrainingLoopOptions loop;
  loop.checkpoint = plan.checkpoint;
  loop.settings = plan.settings;
  loop.output = plan.options.output;
  loop.keep_last = plan.keep == "last";
  loop.communicator = ranks();
  DriveReinforcement training(iterations, kJudgements, learner);
  RobotReinforcementHost host(loop, plan, policy, table, training);
  return host.end(runTraining(loop, &training, &host));
}

}  // namespace lstm_planner
