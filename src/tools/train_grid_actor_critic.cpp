#include <utility>

#include "lstm_planner/grid_world/learning/grid_actor_critic.hpp"
#include "tools/train_commands.hpp"
#include "tools/train_grid_reinforcement.hpp"

namespace lstm_planner {

int trainGridByActorCritic(const std::vector<std::string>& arguments) {
  GridReinforcementPlan plan;
  GridActorCriticParameters parameters;
  CommandLine line("train --task grid --method actor-critic",
                   "trains a network for the grid world by actor-critic learning");
  addGridReinforcementOptions("actor-critic", arguments, &plan, &parameters, &line);
  visitActorCriticParameters(parameters, "cells", line.everyParameter());
  visitGridActorCriticParameters(parameters, line.everyParameter());
  if (!line.parse(arguments)) return 0;
  finishGridReinforcement(&plan, &parameters);
  visitActorCriticParameters(parameters, "cells", noteIn(&plan.settings));
  visitGridActorCriticParameters(parameters, noteIn(&plan.settings));
  LayerStack layers = firstLayers(&plan.options);
  parameters.encoder = plan.options.encoder;
  const auto learner = makeGridActorCritic(parameters, std::move(layers));
  return trainByReinforcement(plan, learner.get());
}

}  // namespace lstm_planner
