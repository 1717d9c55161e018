#include <utility>

#include "lstm_planner/grid_world/learning/grid_q_learning.hpp"
#include "tools/q_learning_options.hpp"
#include "tools/train_commands.hpp"
#include "tools/train_grid_reinforcement.hpp"

namespace lstm_planner {

int trainGridByQLearning(const std::vector<std::string>& arguments) {
  GridReinforcementPlan plan;
  GridQLearningParameters parameters;
  CommandLine line("train --task grid --method q-learning",
                   "trains a network for the grid world by recurrent Q-learning");
  addGridReinforcementOptions("q-learning", arguments, &plan, &parameters, &line);
  addQLearningOptions("cell", "updates", &parameters, &line);
  if (!line.parse(arguments)) return 0;
  finishGridReinforcement(&plan, &parameters);
  plan.settings.update(qLearningSettings(parameters));
  LayerStack layers = firstLayers(&plan.options);
  parameters.encoder = plan.options.encoder;
  GridQLearning learner(parameters, std::move(layers));
  return trainByReinforcement(plan, &learner);
}

}  // namespace lstm_planner
