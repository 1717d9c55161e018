#include <string>
#include <utility>

#include "lstm_planner/practice/drive_actor_critic.hpp"
#include "lstm_planner/practice/recorded_choices.hpp"
#include "tools/recorded_datasets.hpp"
#include "tools/train_commands.hpp"
#include "tools/train_robot_reinforcement.hpp"

namespace lstm_planner {

namespace {

/// Somebody's drives that the network is to follow.
struct FollowedDrives {
  std::vector<std::string> recordings;
  std::vector<std::string> validation;
  double weight = 0.3;
};

const char* const kColumns = "iteration     steps  reward  arrival  entropy  explained";

std::vector<std::string> cellsOf(const ReinforcementReport& report) {
  return {std::to_string(report.update), fixedText(report.steps, 0),   fixedText(report.reward, 3),
          fixedText(report.arrival, 3),  fixedText(report.entropy, 3), fixedText(report.explained, 3)};
}

/// How often the network would have done what the drivers of `recordings` did.
std::string agreementWith(const Dataset& recordings, const DrivePolicy& policy) {
  const ConfusionMatrix taken = preferencesIn(recordings, policy);
  return "; recordings: " + accuracyText(taken) + " (majority-class baseline: " + majorityText(taken) + ")";
}

bool readOptions(const std::vector<std::string>& arguments, RobotReinforcementPlan* plan,
                 DriveActorCriticParameters* parameters, FollowedDrives* followed) {
  DriveActorCriticParameters& p = *parameters;
  CommandLine line("train --method actor-critic",
                   "trains a network for the robot by reinforcement: one that already drives (--init), or a new one");
  addRobotReinforcementOptions(arguments, plan, &p, &line);
  visitPolicyChangeParameters(p, line.everyParameter());
  line.addFiles("recordings", &followed->recordings,
                "datasets of recorded drives: the network also learns to steer as their driver does");
  line.add("recordings-weight", &followed->weight, {1e-6, 1e6},
           "weight of a recorded step; a practised step has the weight 1");
  line.addFiles("validation-recordings", &followed->validation, "recorded drives for validation");
  visitActorCriticParameters(p, "m", line.everyParameter());
  if (!line.parse(arguments)) return false;
  if (plan->init.empty() && !line.given("sharpness")) p.sharpness = 1.0;  // there is nothing to sharpen yet
  finishRobotReinforcement("actor-critic", plan, &p);
  visitPolicyChangeParameters(p, noteIn(&plan->settings));
  if (!followed->recordings.empty()) {
    plan->settings.update({{"recordings", followed->recordings}, {"recordings-weight", followed->weight}});
  }
  visitActorCriticParameters(p, "m", noteIn(&plan->settings));
  return true;
}

}  // namespace

int trainRobotByActorCritic(const std::vector<std::string>& arguments) {
  RobotReinforcementPlan plan;
  DriveActorCriticParameters parameters;
  FollowedDrives followed;
  if (!readOptions(arguments, &plan, &parameters, &followed)) return 0;
  LayerStack layers = firstLayers(plan, &parameters.policy);
  const PolicyDescription& policy = parameters.policy;
  const auto learner = makeDriveActorCritic(parameters, std::move(layers));
  if (!followed.recordings.empty()) learner->follow(readDatasetsFor(policy, followed.recordings), followed.weight);
  RobotLearningTable table{TextTable(kColumns), cellsOf};
  if (!followed.validation.empty()) {
    table.remark = [&policy, recordings = readDatasetsFor(policy, followed.validation)](const LayerStack& network) {
      return agreementWith(recordings, DrivePolicy(policy, network));
    };
  }
  return trainByReinforcement(plan, policy, parameters.iterations, table, learner.get());
}

}  // namespace lstm_planner
