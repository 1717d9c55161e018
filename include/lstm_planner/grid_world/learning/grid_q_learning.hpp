#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lstm_planner/base/common/communicator.hpp"
#include "lstm_planner/grid_world/agent/grid_encoder.hpp"
#include "lstm_planner/grid_world/learning/grid_learner.hpp"

namespace lstm_planner {

/// Weights of the reward that the thesis quotes (Eq. 2.36), R(s) = -sum(tau_r r_i) + tau_d d + tau_theta theta.
///
/// As printed, and with weights above zero, it would send an agent away from its goal and up to the walls. It is read
/// as R(s) = -(tau_r sum(1 / r_i) + tau_d d + tau_theta theta): the minus stands before the whole sum, and the
/// "proximity" r_i is near where the range is short, so that every term is a cost that ends with the arrival. d is the
/// octile distance to the goal, theta the angle between the move before and the path to the goal.
struct ThesisRewardWeights {
  double range = 0.02;     ///< tau_r, times 1 cell / range, of each of the 8 rays
  double distance = 0.02;  ///< tau_d, a cell
  double angle = 0.1;      ///< tau_theta, a rad; the angle is in [0, pi], 0 before the first move
};

/// Q-learning (Watkins and Dayan 1992; thesis Eq. 2.34-2.39) with a recurrent network whose outputs are the values of
/// the moves (Hausknecht and Stone, "Deep recurrent Q-learning for partially observable MDPs", 2015).
///
/// Many agents walk at once, and the weights learn from the window of steps that all of them just made, instead of from
/// a replay memory: such steps are as little correlated as replayed ones (Mnih et al., "Asynchronous methods for deep
/// reinforcement learning", ICML 2016), and the hidden state in which a window starts is the one that today's network
/// has there, where a replayed window would need one that an older network left.
struct GridQLearningParameters {
  enum class Reward {
    kProgress,  ///< cells nearer to the goal by the true shortest path, less a cost a step, as GridActorCritic
    kThesis,    ///< Eq. 2.36, of the state in which the step starts
  };
  GridEncoderParameters encoder;
  int updates = 20000;     ///< of the weights, over all epochs
  int agents = 256;        ///< at a time; rounded up to whole tiles
  int window = 64;         ///< steps of each agent an update: errors go back that far
  int max_steps = 1000;    ///< of an episode
  double discount = 0.97;  ///< gamma, a step, in [0, 1)

  /// lambda in [0, 1] of returns that look further than one step, up to the next move that was not the best (Watkins's
  /// Q(lambda)); 0: one-step targets, Eq. 2.38.
  double trace_decay = 0.8;

  /// The best next move is chosen by the network that learns, its value read off the target network (van Hasselt et
  /// al., "Deep reinforcement learning with double Q-learning", AAAI 2016); off: both by the target network.
  bool double_q = true;
  int target_interval = 50;        ///< updates between copies of the weights into the target network
  double exploration_start = 1.0;  ///< share of moves at random (epsilon), sinking linearly
  double exploration_end = 0.05;
  double exploration_share = 0.3;  ///< of the updates, after which exploration_end is reached
  Reward reward = Reward::kProgress;
  double step_cost = 0.2;       ///< cells; kProgress only
  double arrival_bonus = 10.0;  ///< cells; kProgress only
  ThesisRewardWeights thesis_reward;
  double value_scale = 20.0;  ///< an output of the network times this is a value, cells
  double huber = 5.0;         ///< cells; errors beyond it count by their size, not its square
  double learning_rate = 0.003;
  double max_gradient_norm = 0.5;
  std::uint64_t seed = 1;
  int threads = 2;                            ///< does not change the result
  Communicator* communicator = oneProcess();  ///< ranks that share the agents; does not change the result
};

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const GridQLearningParameters& parameters);

/// Learns in place, update by update.
class GridQLearning : public GridLearner {
 public:
  /// `layers` with weights to start from; GridEncoder says how many inputs and outputs they have. Throws
  /// std::invalid_argument for what does not fit.
  GridQLearning(const GridQLearningParameters& parameters, LayerStack layers);
  ~GridQLearning() override;

  void startEpoch(int epoch, const GridCourse& course) override;
  /// Throws std::logic_error before the first epoch.
  void update() override;
  /// Means over nothing are 0.
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
