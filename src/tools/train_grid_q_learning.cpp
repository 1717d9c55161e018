#include <utility>

#include "lstm_planner/grid_world/learning/grid_q_learning.hpp"
#include "lstm_planner/training/q_learner.hpp"
#include "tools/train_commands.hpp"
#include "tools/train_grid_reinforcement.hpp"

namespace lstm_planner {

namespace {

/// By the names of --reward.
const Choices<QLearningParameters::Reward>& rewards() {
  static const Choices<QLearningParameters::Reward> choices = {{"progress", QLearningParameters::Reward::kProgress},
                                                               {"thesis", QLearningParameters::Reward::kThesis}};
  return choices;
}

}  // namespace

int trainGridByQLearning(const std::vector<std::string>& arguments) {
  GridReinforcementPlan plan;
  GridQLearningParameters parameters;
  CommandLine line("train --task grid --method q-learning",
                   "trains a network for the grid world by recurrent Q-learning");
  addGridReinforcementOptions("q-learning", arguments, &plan, &parameters, &line);
  line.addChoice(
      "reward", &parameters.reward, rewards(),
      "progress (how much shorter the true shortest path to the goal has become, minus a cost) or thesis (Eq. 2.36)");
  visitQLearningParameters(parameters, "cells", "updates", line.everyParameter());
  if (!line.parse(arguments)) return 0;
  finishGridReinforcement(&plan, &parameters);
  plan.settings["reward"] = nameOf(parameters.reward, rewards());
  visitQLearningParameters(parameters, "cells", "updates", noteIn(&plan.settings));
  LayerStack layers = firstLayers(&plan.options);
  parameters.encoder = plan.options.encoder;
  const auto learner = makeGridQLearning(parameters, std::move(layers));
  return trainByReinforcement(plan, learner.get());
}

}  // namespace lstm_planner
