#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/learning/grid_learner.hpp"
#include "lstm_planner/training/actor_critic.hpp"

namespace lstm_planner {

/// Advantage actor-critic (Mnih et al., "Asynchronous methods for deep reinforcement learning", ICML 2016, in its
/// synchronous form) with generalised advantages (Schulman et al., ICLR 2016). Actions are always those that the shield
/// allows. The reward is what a step brings the agent nearer to the goal by the true shortest path, less a cost a step;
/// neither that distance nor the critic, which sees it, is known to the agent that is shipped.
///
/// If it remembers the boundary, the network can imitate boundary following at first, and go on from there.
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
  /// Of the updates, the first ones, in which the network learns to choose the moves of a teacher that follows the
  /// boundary. Needs the inputs kBoundary. The network chooses more and more of the moves itself.
  int taught_updates = 0;
  /// Progress counts as a potential: the distance after a step is multiplied by the discount. Without it, a path that
  /// first leads away from the goal seems worse than it is, the more so the longer it is.
  bool potential = false;
};

/// Visits those of its own, named as the options; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitGridActorCriticParameters(Parameters& p, const Visitor& visit) {
  visit("taught-updates", p.taught_updates, {0, 1e9}, "",
        "updates at the start in which the network imitates boundary following; needs --inputs boundary");
  visit("potential", p.potential, {0, 1}, "",
        "multiplies the distance after a step by the discount: then the reward of what a step brings the agent nearer "
        "does not change which policy is the best");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const GridActorCriticParameters& parameters);

/// `layers` are the policy's, with weights to start from; GridEncoder says how many inputs and outputs it has. Throws
/// std::invalid_argument for what does not fit.
std::unique_ptr<GridLearner> makeGridActorCritic(const GridActorCriticParameters& parameters, LayerStack layers);

}  // namespace lstm_planner
