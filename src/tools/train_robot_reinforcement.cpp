#include "tools/train_robot_reinforcement.hpp"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <utility>

#include "lstm_planner/base/learning/training_checkpoint.hpp"
#include "tools/interruption.hpp"
#include "tools/progress.hpp"
#include "tools/ranks.hpp"

namespace lstm_planner {

namespace {

/// Times that the network is judged, and a checkpoint written, in a whole training.
constexpr int kJudgements = 10;

class RobotReinforcement {
 public:
  RobotReinforcement(const RobotReinforcementPlan& plan, const PolicyDescription& policy, int iterations,
                     RobotLearner* learner)
      : plan_(plan), policy_(policy), iterations_(iterations), learner_(*learner) {}

  int run() {
    const Interruption interruption;
    restore();
    std::cout << learner_.columns() << " | validation drives" << std::endl;
    if (learner_.iterations() == 0 || isLast()) judge();
    const int interval = std::max(1, iterations_ / kJudgements);
    while (learner_.iterations() < iterations_) {
      std::cout << learner_.iterate() << std::endl;
      const int done = learner_.iterations();
      bar_.show(static_cast<double>(done) / iterations_);
      const bool stop = interruption.wanted() && done < iterations_;
      // A break leaves no trace: it is judged only where nothing else is kept.
      const bool due = done % interval == 0 || done == iterations_;
      if (due || (stop && plan_.checkpoint.empty())) judge();
      if (due || stop) writeCheckpoint();
      if (stop) {
        std::cout << "interrupted; "
                  << (plan_.checkpoint.empty() ? "without --checkpoint the training cannot be gone on with"
                                               : "the same command goes on from here")
                  << std::endl;
        return interruption.exitStatus();
      }
    }
    std::cout << "wrote " << plan_.options.output << ": efficiency " << std::fixed << std::setprecision(3) << best_
              << std::endl;
    return 0;
  }

 private:
  /// The best of several judgements owes something to luck; the last network owes nothing to it.
  bool isLast() const { return plan_.keepsLast() && learner_.iterations() == iterations_; }

  /// Keeps the most efficient network, or the last.
  void judge() {
    const DriveScore score =
        judgeDrives(DrivePolicy(policy_, learner_.layers()), plan_.options.course, plan_.options.validation,
                    plan_.options.max_steps, plan_.options.seed, plan_.options.threads);
    const bool best = score.efficiency > best_;
    if (best || isLast()) {
      best_ = score.efficiency;
      if (isFirstRank()) writeRobotModel(plan_.options, policy_, learner_.layers(), score);
    }
    std::cout << std::string(learner_.columns().size() + 1, ' ') << "| " << toText(score) << (best ? " (best)" : "")
              << learner_.remark() << std::endl;
  }

  void restore() {
    if (plan_.checkpoint.empty()) return;
    const auto checkpoint = readTrainingCheckpoint(plan_.checkpoint, plan_.settings);
    if (!checkpoint) return;
    learner_.restore(checkpoint->learner);
    const bool kept = checkpoint->progress.value("output", "") == plan_.options.output &&
                      std::filesystem::exists(plan_.options.output);
    if (kept) best_ = checkpoint->progress.at("best").get<double>();
    std::cout << "going on from " << plan_.checkpoint << " after iteration " << learner_.iterations() << std::endl;
  }

  void writeCheckpoint() const {
    if (plan_.checkpoint.empty() || !isFirstRank()) return;
    writeTrainingCheckpoint(
        plan_.checkpoint, {plan_.settings, {{"best", best_}, {"output", plan_.options.output}}, learner_.checkpoint()});
  }

  const RobotReinforcementPlan& plan_;
  const PolicyDescription& policy_;
  const int iterations_;
  RobotLearner& learner_;
  Progress bar_;
  double best_ = -1.0;
};

}  // namespace

void finishRobotNetwork(const CommandLine& line, RobotReinforcementPlan* plan, EncoderParameters* encoder) {
  if (plan->init.empty()) {
    finishRobotNetworkOptions(line, &plan->network, encoder);
  } else {
    checkModelDecides(line);
  }
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
                         RobotLearner* learner) {
  return RobotReinforcement(plan, policy, iterations, learner).run();
}

}  // namespace lstm_planner
