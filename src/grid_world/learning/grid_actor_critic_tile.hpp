#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "grid_world/learning/grid_lanes.hpp"
#include "grid_world/learning/grid_tiles.hpp"
#include "lstm_planner/grid_world/learning/grid_actor_critic.hpp"
#include "lstm_planner/training/critic.hpp"
#include "lstm_planner/training/lane_network.hpp"

namespace lstm_planner {

/// What is reported of a window, and what the next one depends on.
struct GridActorCriticSums {
  explicit GridActorCriticSums(std::size_t sets = 0) : judged(sets) {}

  double reward = 0, entropy = 0;
  GridEpisodeSums episodes;
  CriticSums judged;

  void operator+=(const GridActorCriticSums& other);
};
std::vector<double*> numbersOf(GridActorCriticSums* sums);

/// What is done in a window.
struct GridActorCriticLesson {
  double entropy_weight = 0.0;
  bool taught = false;         ///< the network is to choose what taughtMove() says
  double network_share = 1.0;  ///< of the moves, while it is taught: the others are the teacher's
};

struct GridActorCriticTile : GridTile {
  std::vector<bool> led_by_teacher;  ///< by agent, while the network is taught
  Eigen::VectorXf policy_gradient;   ///< sums over the window's steps
  Eigen::VectorXf critic_gradient;
};

/// What only the critic sees: the true distance in two forms, its ratio to the distance as the crow flies, and what
/// each move would gain.
constexpr int kGridPrivilegedInputs = 3 + kGridMoveCount;

/// Leads tiles of agents through a window, and works out both gradients. One a thread.
class GridActorCriticTileRunner {
 public:
  /// `parameters` must outlive the runner.
  GridActorCriticTileRunner(const GridActorCriticParameters& parameters, const LayerStack& policy,
                            const LayerStack& critic);

  int actors() const { return lanes_.actors(); }  ///< of a tile

  /// `advantage_variances` by set of the course.
  GridActorCriticSums run(const Eigen::VectorXf& policy_parameters, const Eigen::VectorXf& critic_parameters,
                          const GridActorCriticLesson& lesson, const std::vector<double>& advantage_variances,
                          GridActorCriticTile* tile);

 private:
  /// What an agent did in one step of a window.
  struct Step {
    std::array<float, kGridMoveCount> probabilities{};
    int direction = 0;
    int taught = kNoPath;  ///< what the network is to choose
    std::size_t set = 0;
    GridActor::Outcome outcome;
  };

  Step& stepOf(int step, int actor) { return steps_[static_cast<std::size_t>(step * actors() + actor)]; }
  void observe(int step, int actor, GridActor* walker);
  void walk(const Eigen::VectorXf& policy_parameters, int step, GridActorCriticTile* tile);
  void choose(const float* preferences, int actor, GridActor& walker, Step& done) const;
  void act(const float* preferences, int step, int actor, GridActorCriticTile* tile);
  void teach(GridActor* walker, std::vector<bool>::reference led_by_teacher, Step* done) const;
  void judge(const float* values, int actor, const std::vector<double>& advantage_variances);
  double fillPolicyGradient(const Step& done, int step, int actor, double advantage);

  const GridActorCriticParameters& parameters_;
  GridLanes lanes_;
  LaneNetwork policy_;
  LaneNetwork critic_;
  GridRewards rewards_;
  GridActorCriticLesson lesson_;
  std::vector<Step> steps_;
  GridActorCriticSums sums_;  ///< of the window
};

}  // namespace lstm_planner
