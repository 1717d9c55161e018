#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "grid_world/learning/grid_actor.hpp"
#include "lstm_planner/base/learning/lane_network.hpp"
#include "lstm_planner/grid_world/learning/grid_actor_critic.hpp"

namespace lstm_planner {

/// What is reported of a window, and what the next one depends on.
struct GridActorCriticSums {
  double steps = 0, reward = 0, entropy = 0, arrived = 0, ended = 0, ratio = 0;
  double returns = 0, squared_returns = 0, squared_errors = 0;
  std::vector<double> set_steps, set_squared_advantages;  ///< by set of the course

  static GridActorCriticSums ofSets(std::size_t sets);
  void operator+=(const GridActorCriticSums& other);
  /// Every number, to be read or written.
  std::vector<double*> numbers();
};

/// Some agents that go through a window together, with the hidden state they carry between windows.
struct GridActorCriticTile {
  std::vector<GridActor> actors;
  std::vector<float> state;
  Eigen::VectorXf policy_gradient;
  Eigen::VectorXf critic_gradient;
  GridActorCriticSums sums;
};

/// The critic's layers for so many inputs of the policy: it also sees true distances.
LayerStack makeCritic(int policy_inputs, const std::vector<int>& units, std::uint64_t seed);

/// Leads tiles of agents through a window, and works out both gradients. One a thread.
class GridActorCriticTileRunner {
 public:
  /// `parameters` must outlive the runner.
  GridActorCriticTileRunner(const GridActorCriticParameters& parameters, const LayerStack& policy,
                            const LayerStack& critic);

  int actors() const { return actors_; }  ///< of a tile

  /// `advantage_variances` by set of the course.
  void run(const Eigen::VectorXf& policy_parameters, const Eigen::VectorXf& critic_parameters, double entropy_weight,
           const std::vector<double>& advantage_variances, GridActorCriticTile& tile);

 private:
  /// What an agent did in one step of a window.
  struct Step {
    std::array<float, kGridMoveCount> probabilities{};
    int direction = 0;
    std::size_t set = 0;
    double reward = 0.0;
    double value = 0.0;
    bool arrived = false;
    bool timed_out = false;
  };

  Step& stepOf(int step, int actor) { return steps_[static_cast<std::size_t>(step * actors_ + actor)]; }
  int preferenceAt(int actor, int direction) const;
  void look(int step, int actor, GridActorCriticTile& tile);
  void walk(const Eigen::VectorXf& policy_parameters, int step, GridActorCriticTile& tile);
  void choose(const float* preferences, int actor, GridActor& walker, Step& done) const;
  void act(const float* preferences, int step, int actor, GridActorCriticTile& tile);
  void judge(const float* values, int actor, double entropy_weight, const std::vector<double>& advantage_variances,
             GridActorCriticTile& tile);
  double fillPolicyGradient(const Step& done, int step, int actor, double advantage, double entropy_weight);

  const GridActorCriticParameters& parameters_;
  GridEncoder encoder_;
  int actors_;
  LaneNetwork policy_;
  LaneNetwork critic_;
  std::vector<Step> steps_;
};

}  // namespace lstm_planner
