#include <iomanip>
#include <sstream>
#include <utility>

#include "lstm_planner/robot/learning/drive_actor_critic.hpp"
#include "lstm_planner/robot/learning/recorded_choices.hpp"
#include "tools/actor_critic_options.hpp"
#include "tools/ranges.hpp"
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

class RobotActorCritic : public RobotLearner {
 public:
  RobotActorCritic(const DriveActorCriticParameters& parameters, LayerStack layers, const FollowedDrives& followed)
      : policy_(parameters.policy), learner_(parameters, std::move(layers)) {
    if (!followed.recordings.empty()) {
      learner_.follow(readDatasetsFor(policy_, followed.recordings), followed.weight);
    }
    if (!followed.validation.empty()) validation_ = readDatasetsFor(policy_, followed.validation);
  }

  std::string columns() const override { return "iteration     steps  reward  arrival  entropy  explained"; }
  std::string iterate() override {
    const DriveActorCriticReport report = learner_.iterate();
    std::ostringstream line;
    line << std::fixed << std::setw(9) << report.iteration << std::setprecision(0) << std::setw(10) << report.steps
         << std::setprecision(3) << std::setw(8) << report.reward << std::setw(9) << report.arrival << std::setw(9)
         << report.entropy << std::setw(11) << report.explained;
    return line.str();
  }
  int iterations() const override { return learner_.iterations(); }
  const LayerStack& layers() const override { return learner_.layers(); }
  std::string remark() const override {
    if (validation_.recordings.empty()) return "";
    const ConfusionMatrix taken = preferencesIn(validation_, DrivePolicy(policy_, learner_.layers()));
    return "; recordings: " + accuracyText(taken) + " (always the most frequent label: " + majorityText(taken) + ")";
  }
  std::vector<std::uint8_t> checkpoint() const override { return learner_.checkpoint(); }
  void restore(const std::vector<std::uint8_t>& checkpoint) override { learner_.restore(checkpoint); }

 private:
  PolicyDescription policy_;
  DriveActorCritic learner_;
  Dataset validation_;
};

bool readOptions(const std::vector<std::string>& arguments, RobotReinforcementPlan* plan,
                 DriveActorCriticParameters* parameters, FollowedDrives* followed) {
  DriveActorCriticParameters& p = *parameters;
  CommandLine line("train --method actor-critic",
                   "the robot, by reinforcement: of a network that drives already, or of a new one");
  addRobotReinforcementOptions(arguments, plan, &p, &line);
  line.add("sharpness", &p.sharpness, kAnyScale, "times the first network's preferences");
  line.add("clip", &p.clip, kAnyScale, "how far a probability may change at once");
  line.addFiles("recordings", &followed->recordings,
                "datasets of somebody's drives: learns to steer as they do, too, without forgetting how to arrive");
  line.add("recordings-weight", &followed->weight, {1e-6, 1e6}, "of a mean recorded step beside a mean practised one");
  line.addFiles("validation-recordings", &followed->validation, "drives of theirs to judge it by");
  addActorCriticOptions("m", &p, &line);
  if (!line.parse(arguments)) return false;
  if (plan->init.empty() && !line.given("sharpness")) p.sharpness = 1.0;  // there is nothing to sharpen yet
  finishRobotReinforcement("actor-critic", plan, &p);
  plan->settings.update({{"sharpness", p.sharpness}, {"clip", p.clip}});
  if (!followed->recordings.empty()) {
    plan->settings.update({{"recordings", followed->recordings}, {"recordings-weight", followed->weight}});
  }
  plan->settings.update(actorCriticSettings(p));
  return true;
}

}  // namespace

int trainRobotByActorCritic(const std::vector<std::string>& arguments) {
  RobotReinforcementPlan plan;
  DriveActorCriticParameters parameters;
  FollowedDrives followed;
  if (!readOptions(arguments, &plan, &parameters, &followed)) return 0;
  LayerStack layers = firstLayers(plan, &parameters.policy);
  RobotActorCritic learner(parameters, std::move(layers), followed);
  return trainByReinforcement(plan, parameters.policy, parameters.iterations, &learner);
}

}  // namespace lstm_planner
