#include <utility>

#include "lstm_planner/grid_world/learning/grid_actor_critic.hpp"
#include "tools/actor_critic_options.hpp"
#include "tools/ranges.hpp"
#include "tools/ranks.hpp"
#include "tools/train_commands.hpp"
#include "tools/train_grid_reinforcement.hpp"

namespace lstm_planner {

namespace {

class ActorCriticLearner : public ReinforcementLearner {
 public:
  ActorCriticLearner(const GridActorCriticParameters& parameters, LayerStack layers)
      : learner_(parameters, std::move(layers)) {}

  void beginEpoch(int epoch, const GridCourse& course) override { learner_.beginEpoch(epoch, course); }
  void update() override { learner_.update(); }
  ReinforcementReport report() override {
    const GridActorCriticReport report = learner_.report();
    return {report.steps, report.reward, report.arrival, report.ratio};
  }
  const LayerStack& layers() const override { return learner_.layers(); }
  std::vector<std::uint8_t> checkpoint() const override { return learner_.checkpoint(); }
  void restore(const std::vector<std::uint8_t>& checkpoint) override { learner_.restore(checkpoint); }

 private:
  GridActorCritic learner_;
};

bool readOptions(const std::vector<std::string>& arguments, ReinforcementPlan* plan,
                 GridActorCriticParameters* learner) {
  GridTrainingOptions& options = plan->options;
  GridActorCriticParameters& p = *learner;
  options.method = "actor-critic";
  options.epochs = p.epochs;
  plan->updates = p.updates;
  options.encoder = p.encoder;
  CommandLine line("train --task grid --method actor-critic", "a network for the grid world, by actor-critic learning");
  addGridTrainingOptions(arguments, &options, &line);
  addReinforcementOptions(plan, &line);
  line.add("agents", &p.agents, kAnyAgents, "at a time");
  line.add("window", &p.window, kAnyWindow, "steps of each agent an update");
  line.add("max-steps", &p.max_steps, kAnySteps, "of a training episode");
  addActorCriticOptions("cells", &p, &line);
  if (!line.parse(arguments)) return false;
  finishReinforcementOptions(plan);
  p.epochs = options.epochs;
  p.updates = plan->updates;
  p.seed = options.seed;
  p.threads = options.threads;
  p.communicator = ranks();
  validate(p);
  plan->settings.update({{"agents", p.agents}, {"window", p.window}, {"max-steps", p.max_steps}});
  plan->settings.update(actorCriticSettings(p));
  return true;
}

}  // namespace

int trainGridByActorCritic(const std::vector<std::string>& arguments) {
  ReinforcementPlan plan;
  GridActorCriticParameters parameters;
  if (!readOptions(arguments, &plan, &parameters)) return 0;
  LayerStack layers = firstLayers(&plan.options);
  parameters.encoder = plan.options.encoder;
  ActorCriticLearner learner(parameters, std::move(layers));
  return trainByReinforcement(plan, &learner);
}

}  // namespace lstm_planner
