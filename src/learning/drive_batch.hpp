#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "drive_practice.hpp"
#include "lane_network.hpp"
#include "lstm_planner/learning/drive_actor_critic.hpp"

namespace lstm_planner {

/// How much the parts of the error weigh.
struct DriveBatchWeights {
  double entropy = 0.0;
  std::vector<double> advantage_variances;  ///< by kind of world
};

/// Drives side by side in lanes, one behind the other, gone through window by window: what an update learns from.
class DriveBatch {
 public:
  /// All must outlive the batch.
  DriveBatch(const DriveActorCriticParameters& parameters, const LayerStack& policy, const LayerStack& critic,
             const std::vector<PracticeEpisode>& episodes);

  /// Works out advantages and returns, and moves the variances towards the advantages'.
  void judge(const Eigen::VectorXf& critic_parameters, std::vector<double>* advantage_variances);

  /// To before the first window, with zero hidden state.
  void rewind();
  /// To the next window; false when there is none.
  bool next();

  /// Gradients of the errors, summed over the window; both return over how many steps. Once a window each.
  double policyGradient(const Eigen::VectorXf& parameters, const DriveBatchWeights& weights, Eigen::VectorXf* gradient);
  double criticGradient(const Eigen::VectorXf& parameters, Eigen::VectorXf* gradient);

  double entropy() const { return steps_seen_ > 0.0 ? entropy_ / steps_seen_ : 0.0; }  ///< mean so far, nat
  double explained() const { return explained_; }  ///< share of the returns' variance, by the critic before learning

 private:
  struct Slot {
    const PracticeEpisode* episode = nullptr;
    std::size_t step = 0;
    float value = 0.0f;
    float advantage = 0.0f;
  };
  void pack(const std::vector<PracticeEpisode>& episodes);
  Slot& slotOf(int time, int lane);
  /// Rows of one slot's inputs into those of a network: the first `count`, `stride` apart.
  void fillInputs(const Slot& slot, int count, float* input, int stride) const;
  const float* criticValues(const Eigen::VectorXf& parameters);
  void judgeLane(int lane, std::vector<double>* squares, std::vector<double>* counts);
  void fillPolicyGradient(const Slot& slot, int time, int lane, const DriveBatchWeights& weights);

  const DriveActorCriticParameters& parameters_;
  int actions_;
  int policy_inputs_;
  LaneNetwork policy_;
  LaneNetwork critic_;
  int windows_ = 0;
  int window_ = -1;
  std::vector<Slot> slots_;
  double entropy_ = 0.0;
  double steps_seen_ = 0.0;
  double explained_ = 0.0;
};

}  // namespace lstm_planner
