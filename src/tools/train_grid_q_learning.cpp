#include <utility>

#include "lstm_planner/grid_world/learning/grid_q_learning.hpp"
#include "tools/q_learning_options.hpp"
#include "tools/ranges.hpp"
#include "tools/ranks.hpp"
#include "tools/train_commands.hpp"
#include "tools/train_grid_reinforcement.hpp"

namespace lstm_planner {

namespace {

class QLearner : public ReinforcementLearner {
 public:
  QLearner(const GridQLearningParameters& parameters, LayerStack layers) : learner_(parameters, std::move(layers)) {}

  void beginEpoch(int epoch, const GridCourse& course) override { learner_.beginEpoch(epoch, course); }
  void update() override { learner_.update(); }
  ReinforcementReport report() override {
    const GridQLearningReport report = learner_.report();
    return {report.steps, report.reward, report.arrival, report.ratio};
  }
  const LayerStack& layers() const override { return learner_.layers(); }
  std::vector<std::uint8_t> checkpoint() const override { return learner_.checkpoint(); }
  void restore(const std::vector<std::uint8_t>& checkpoint) override { learner_.restore(checkpoint); }

 private:
  GridQLearning learner_;
};

bool readOptions(const std::vector<std::string>& arguments, ReinforcementPlan* plan, GridQLearningParameters* learner) {
  GridTrainingOptions& options = plan->options;
  GridQLearningParameters& p = *learner;
  options.method = "q-learning";
  options.epochs = 10;
  options.encoder = p.encoder;
  plan->updates = p.updates;
  CommandLine line("train --task grid --method q-learning", "a network for the grid world, by recurrent Q-learning");
  addGridTrainingOptions(arguments, &options, &line);
  addReinforcementOptions(plan, &line);
  line.add("agents", &p.agents, kAnyAgents, "at a time");
  line.add("window", &p.window, kAnyWindow, "steps of each agent an update");
  line.add("max-steps", &p.max_steps, kAnySteps, "of a training episode");
  addQLearningOptions("cell", "updates", &p, &line);
  if (!line.parse(arguments)) return false;
  finishReinforcementOptions(plan);
  p.updates = plan->updates;
  p.seed = options.seed;
  p.threads = options.threads;
  p.communicator = ranks();
  validate(p);
  plan->settings.update({{"agents", p.agents}, {"window", p.window}, {"max-steps", p.max_steps}});
  plan->settings.update(qLearningSettings(p));
  return true;
}

}  // namespace

int trainGridByQLearning(const std::vector<std::string>& arguments) {
  ReinforcementPlan plan;
  GridQLearningParameters parameters;
  if (!readOptions(arguments, &plan, &parameters)) return 0;
  LayerStack layers = firstLayers(&plan.options);
  parameters.encoder = plan.options.encoder;
  QLearner learner(parameters, std::move(layers));
  return trainByReinforcement(plan, &learner);
}

}  // namespace lstm_planner
