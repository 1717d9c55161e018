#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lstm_planner/base/common/communicator.hpp"
#include "lstm_planner/base/learning/optimiser.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/learning/grid_learner.hpp"

namespace lstm_planner {

/// Advantage actor-critic (Mnih et al., "Asynchronous methods for deep reinforcement learning", ICML 2016, in its
/// synchronous form) with generalised advantages (Schulman et al., ICLR 2016). Actions are always those that the shield
/// allows. The reward is what a step brings the agent nearer to the goal by the true shortest path, less a cost a step;
/// neither that distance nor the critic, which sees it, is known to the agent that is shipped.
struct GridActorCriticParameters {
  GridEncoderParameters encoder;
  std::vector<int> critic_units = {48, 32};
  int updates = 20000;      ///< of the weights, over all epochs
  int agents = 128;         ///< at a time; rounded up to whole tiles
  int window = 64;          ///< steps of each agent an update: errors go back that far
  int max_steps = 1500;     ///< of an episode
  double discount = 0.997;  ///< a step
  double advantage_decay = 0.95;
  double entropy_start = 0.0015;  ///< weight of the entropy, sinking linearly
  double entropy_end = 0.0001;
  double step_cost = 0.2;       ///< cells
  double arrival_bonus = 10.0;  ///< cells
  double learning_rate = 0.003;
  double critic_learning_rate = 0.003;
  double max_gradient_norm = 0.5;
  std::uint64_t seed = 1;
  int threads = 2;                            ///< does not change the result
  Communicator* communicator = oneProcess();  ///< ranks that share the agents; does not change the result
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const GridActorCriticParameters& parameters);

/// Learns in place, update by update.
class GridActorCritic : public GridLearner {
 public:
  /// `layers` are the policy's, with weights to start from; GridEncoder says how many inputs and outputs it has. Throws
  /// std::invalid_argument for what does not fit.
  GridActorCritic(const GridActorCriticParameters& parameters, LayerStack layers);
  ~GridActorCritic() override;

  void startEpoch(int epoch, const GridCourse& course) override;
  void update() override;
  ReinforcementReport report() override;
  int updates() const override;
  const LayerStack& layers() const override;
  std::vector<std::uint8_t> checkpoint() const override;
  void restore(const std::vector<std::uint8_t>& checkpoint) override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lstm_planner
