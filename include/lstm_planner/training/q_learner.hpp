#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/training/learning_progress.hpp"
#include "lstm_planner/training/optimiser.hpp"

namespace lstm_planner {

/// One step of an agent. Values are in the reward's unit.
struct QTransition {
  int direction = 0;
  double estimate = 0.0;  ///< Q(s, a) of the move, by the network that learns
  double reward = 0.0;
  double value = 0.0;   ///< max over a of Q(s, a) by the target network
  bool greedy = false;  ///< whether the move was the best by the network that learns
  bool arrived = false;
  bool timed_out = false;  ///< the episode was cut off after this step
};

/// What the estimates of consecutive steps should have been: r + gamma max_a' Q(s', a') for trace_decay 0 (Eq. 2.38),
/// otherwise Watkins's Q(lambda). Of the last of `steps` only the value counts, which is that of the state after the
/// others; it gets no target.
///
/// If an episode was cut off, the next state is unknown: the target is the estimate, so that nothing is learned.
std::vector<double> lambdaTargets(const std::vector<QTransition>& steps, double discount, double trace_decay);

/// How a network learns the values of moves (Watkins and Dayan 1992; thesis Eq. 2.34-2.39).
struct QLearningParameters {
  int window = 64;         ///< steps; errors go back at most that far
  int max_steps = 1000;    ///< of an episode
  double discount = 0.97;  ///< gamma, per step, in [0, 1)

  /// lambda in [0, 1] of returns over several steps, up to the next action that was not the best (Watkins's Q(lambda));
  /// 0: one-step targets, Eq. 2.38.
  double trace_decay = 0.8;

  /// The network that learns chooses the best next action, and the target network gives its value (van Hasselt et al.,
  /// "Deep reinforcement learning with double Q-learning", AAAI 2016); off: the target network does both.
  bool double_q = true;
  int target_interval = 50;  ///< updates between copies of the weights into the target network
  double huber = 5.0;        ///< larger errors of values count linearly, not by their square
  double learning_rate = 0.003;
  double max_gradient_norm = 0.5;
  std::uint64_t seed = 1;
  int threads = 2;  ///< does not change the result
};

/// Visits the parameters that have an option, by the option's name; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitQLearningParameters(Parameters& p, const Visitor& visit) {
  visit("discount", p.discount, {0.0, 1.0}, "", "discount factor per step (gamma)");
  visit("trace-decay", p.trace_decay, {0.0, 1.0}, "", "decay of the returns over several steps (lambda); 0: one step");
  visit("double-q", p.double_q, {}, "",
        "1: double Q-learning: the learning network chooses the next action, and the target network gives its value; "
        "0: the target network does both");
  visit("target-interval", p.target_interval, {1, 1e9}, "",
        "updates between copies of the weights into the target network");
  visit("huber", p.huber, {1e-9, 1e9}, "",
        "limit of the Huber loss: larger errors count linearly, not by their square");
  visit("rate", p.learning_rate, {1e-9, 100.0}, "", "learning rate");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const QLearningParameters& parameters);

/// The weights of a network of values while it learns, on any course: the target network, optimiser and schedule, and
/// the checkpoint of all this. The learning rate falls to 0 along half a cosine; the share of random actions falls
/// linearly, then stays.
class QLearner : public LearningProgress {
 public:
  /// The layers hold the weights to start from. `updates`: number of updates in the whole training. Throws
  /// std::invalid_argument as validate(OptimiserParameters).
  QLearner(const QLearningParameters& parameters, int updates, const LayerStack& layers);

  const Eigen::VectorXf& weights() const { return weights_; }
  const Eigen::VectorXf& targetWeights() const { return target_weights_; }
  double epsilon() const;  ///< share of random actions, in the next update

  /// Copies the weights into the target network if it is time to.
  void startUpdate();
  /// One step of the optimiser.
  void update(const Eigen::VectorXf& gradient);

  /// Everything that the next update depends on.
  std::vector<std::uint8_t> checkpoint() const;
  /// Throws std::invalid_argument if it is not a checkpoint of the same course and network.
  void restore(const std::vector<std::uint8_t>& checkpoint);

 private:
  QLearningParameters parameters_;
  Eigen::VectorXf weights_;
  Eigen::VectorXf target_weights_;
  Optimiser optimiser_;
};

}  // namespace lstm_planner
