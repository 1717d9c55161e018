#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/training/learning_progress.hpp"
#include "lstm_planner/training/optimiser.hpp"

namespace lstm_planner {

/// What every actor-critic training needs, on any course. Both learning rates fall to 0 along half a cosine.
struct ActorCriticParameters {
  int window = 32;               ///< steps; errors go back at most that far
  int max_steps = 300;           ///< of an episode
  double discount = 0.99;        ///< a step
  double entropy_start = 0.003;  ///< weight of the entropy, changing linearly
  double entropy_end = 0.0003;
  double learning_rate = 0.002;
  double critic_learning_rate = 0.005;
  double max_gradient_norm = 0.5;
  std::uint64_t seed = 1;
  int threads = 2;  ///< does not change the result
};

/// Visits the parameters that have an option, by the option's name; see parameter_visitors.hpp.
template <typename Parameters, typename Visitor>
void visitActorCriticParameters(Parameters& p, const Visitor& visit) {
  visit("discount", p.discount, {0.0, 1.0}, "", "discount factor per step (gamma)");
  visit("entropy-start", p.entropy_start, {0.0, 1000.0}, "", "weight of the entropy at the start");
  visit("entropy-end", p.entropy_end, {0.0, 1000.0}, "", "weight of the entropy at the end");
  visit("rate", p.learning_rate, {1e-9, 100.0}, "", "learning rate");
  visit("critic-rate", p.critic_learning_rate, {1e-9, 100.0}, "", "learning rate of the critic");
}

/// Throws std::invalid_argument naming the parameter, its value and what was expected.
void validate(const ActorCriticParameters& parameters);

/// Sums over the steps that a critic has judged: how well it predicts the returns, and how much the advantages vary in
/// each set of the course.
struct CriticSums {
  explicit CriticSums(std::size_t sets = 0) : set_steps(sets), set_squared_advantages(sets) {}

  double steps = 0.0, returns = 0.0, squared_returns = 0.0;
  double squared_errors = 0.0;
  std::vector<double> set_steps, set_squared_advantages;

  /// Adds a step in a set; the critic gives its state the value `value`.
  void count(std::size_t set, double value, double advantage);

  CriticSums& operator+=(const CriticSums& other);  ///< of as many sets

  /// Share of the variance of the returns that the critic explains.
  double explained() const;
  /// Moves each variance by that share towards the variance of these steps; sets without steps keep theirs.
  void moveVariances(double share, std::vector<double>* variances) const;
};

/// The weights of a policy and its critic while they learn, on any course: optimisers, schedule, the variance of the
/// advantages, and the checkpoint of all this.
class ActorCritic : public LearningProgress {
 public:
  /// The layers hold the weights to start from. `sets`: number of parts of the course, each with its own variance.
  /// `updates`: number of updates in the whole training.
  ActorCritic(const ActorCriticParameters& parameters, int updates, const LayerStack& policy, const LayerStack& critic,
              std::size_t sets);

  const Eigen::VectorXf& policy() const { return policy_; }
  const Eigen::VectorXf& critic() const { return critic_; }

  double entropyWeight() const;  ///< of the next update

  /// One step of an optimiser. `gradient` is the sum over `steps` steps of the agents.
  void updatePolicy(const Eigen::VectorXf& gradient, double steps);
  void updateCritic(const Eigen::VectorXf& gradient, double steps);

  /// One for each set, so that each set counts the same: a gain that is large in the open is small in a maze. They
  /// start at 1.
  std::vector<double>& advantageVariances() { return advantage_variances_; }

  /// Everything that the next update depends on.
  std::vector<std::uint8_t> checkpoint() const;
  /// Throws std::invalid_argument if it is not a checkpoint of the same course and networks.
  void restore(const std::vector<std::uint8_t>& checkpoint);

 private:
  ActorCriticParameters parameters_;
  Eigen::VectorXf policy_;
  Eigen::VectorXf critic_;
  Optimiser policy_optimiser_;
  Optimiser critic_optimiser_;
  std::vector<double> advantage_variances_;
};

/// Generalised advantages (Schulman et al., "High-dimensional continuous control using generalized advantage
/// estimation", ICLR 2016), from the last step back.
class Advantages {
 public:
  Advantages(double discount, double decay) : discount_(discount), decay_(decay) {}

  /// How a step ended. The first call must not give kNone. After kCutOff the critic's value of the last state stands
  /// for the rest: the episode would have gone on from about the same place.
  enum class End { kNone, kArrived, kCutOff };

  /// The advantage of the step before that of the last call. `value`: the critic's, of the state in which the step
  /// starts.
  double before(double reward, double value, End end) {
    const double following = end == End::kArrived ? 0.0 : (end == End::kCutOff ? value : next_value_);
    const double error = reward + discount_ * following - value;
    advantage_ = error + (end == End::kNone ? discount_ * decay_ * advantage_ : 0.0);
    next_value_ = value;
    return advantage_;
  }

 private:
  double discount_;
  double decay_;
  double next_value_ = 0.0;
  double advantage_ = 0.0;
};

}  // namespace lstm_planner
