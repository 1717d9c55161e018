#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "lstm_planner/practice/drive_actor_critic.hpp"
#include "lstm_planner/training/lane_network.hpp"
#include "practice/drive_queues.hpp"
#include "practice/drive_views.hpp"

namespace lstm_planner {

/// How much the parts of the error weigh.
struct DriveBatchWeights {
  double entropy = 0.0;
  std::vector<double> advantage_variances;  ///< by kind of world
};

/// How undecided the policy was.
struct DriveTileEntropy {
  double sum = 0.0;  ///< nat
  double steps = 0.0;

  DriveTileEntropy& operator+=(const DriveTileEntropy& other) {
    sum += other.sum;
    steps += other.steps;
    return *this;
  }
};

/// Some queues of drives, gone through window by window: what one thread works on.
class DriveTile {
 public:
  /// All must outlive the tile.
  DriveTile(const DriveActorCriticParameters& parameters, const LayerStack& policy, const LayerStack& critic);

  DriveQueues& queues() { return queues_; }

  /// Works out values, advantages and returns; the sets of the sums are the kinds of worlds.
  CriticSums judge(const Eigen::VectorXf& critic_parameters);

  /// To before the first window, with zero hidden state.
  void rewind();

  /// Gradients of the errors, summed over a window; both return over how many steps. The windows in their order.
  double policyGradient(int window, const Eigen::VectorXf& parameters, const DriveBatchWeights& weights);
  double criticGradient(int window, const Eigen::VectorXf& parameters);
  const Eigen::VectorXf& gradient() const { return gradient_; }

  const DriveTileEntropy& entropy() const { return entropy_; }

 private:
  const float* criticValues(int window, const Eigen::VectorXf& parameters);
  void judgeQueue(int queue, CriticSums* sums);
  /// How likely the actions are now, of those that could be chosen.
  std::vector<double> probabilitiesOf(const DriveSlot& slot, int time, int queue) const;
  void fillImitationGradient(const DriveSlot& slot, int time, int queue);
  void fillPolicyGradient(const DriveSlot& slot, int time, int queue, const DriveBatchWeights& weights);

  const DriveActorCriticParameters& parameters_;
  int actions_;
  int policy_inputs_;
  DriveViews views_;
  DriveQueues queues_;
  LaneNetwork policy_;
  LaneNetwork critic_;
  Eigen::VectorXf gradient_;
  DriveTileEntropy entropy_;
};

}  // namespace lstm_planner
