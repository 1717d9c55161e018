#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lstm_planner/base/learning/actor_critic.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/learning/grid_learner.hpp"

namespace lstm_planner {

/// Advantage actor-critic (Mnih et al., "Asynchronous methods for deep reinforcement learning", ICML 2016, in its
/// synchronous form) with generalised advantages (Schulman et al., ICLR 2016). Actions are always those that the shield
/// allows. The reward is what a step brings the agent nearer to the goal by the true shortest path, less a cost a step;
/// neither that distance nor the critic, which sees it, is known to the agent that is shipped.
///
/// Lengths are in cells. An update is made after `window` steps of each agent.
struct GridActorCriticParameters : ActorCriticParameters {
  GridActorCriticParameters() {
    max_steps = 1500;
    discount = 0.997;
    entropy_start = 0.0015;
    entropy_end = 0.0001;
    step_cost = 0.2;
    arrival_bonus = 10.0;
    learning_rate = 0.003;
    critic_learning_rate = 0.003;
  }

  GridEncoderParameters encoder;
  int updates = 20000;  ///< of the weights, over all epochs
  int agents = 128;     ///< at a time; rounded up to whole tiles
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const GridActorCriticParameters& parameters);

/// `layers` are the policy's, with weights to start from; GridEncoder says how many inputs and outputs it has. Throws
/// std::invalid_argument for what does not fit.
std::unique_ptr<GridLearner> makeGridActorCritic(const GridActorCriticParameters& parameters, LayerStack layers);

}  // namespace lstm_planner
