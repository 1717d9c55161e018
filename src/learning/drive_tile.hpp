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

/// A step of a drive, and what is thought of it.
struct DriveSlot {
  const PracticeEpisode* episode = nullptr;  ///< null where the lane has no more drives
  std::size_t step = 0;
  float value = 0.0f;
  float advantage = 0.0f;
};

/// What is added up over the steps of a tile.
struct DriveTileSums {
  std::vector<double> squares, counts;  ///< of the advantages, by kind of world
  double steps = 0.0, returns = 0.0, squared_returns = 0.0, squared_errors = 0.0;
};

/// Some lanes of drives, one drive behind the other in each, gone through window by window: what one thread works on.
/// With eight views, each lane of drives is eight of the policy's network, one for each direction of the odometry frame.
class DriveTile {
 public:
  /// Of drives, in a tile: few where the policy has many views, so that its numbers stay in the cache.
  static int lanesFor(const DriveActorCriticParameters& parameters) {
    return parameters.policy.encoder.views == 1 ? 32 : 8;
  }

  /// All must outlive the tile.
  DriveTile(const DriveActorCriticParameters& parameters, const LayerStack& policy, const LayerStack& critic);

  /// The shortest lane so far, and its length in steps.
  std::size_t shortestLane() const;
  std::size_t lengthOf(std::size_t lane) const { return lanes_[lane].size(); }
  void append(std::size_t lane, const PracticeEpisode& episode);
  std::size_t longest() const;

  /// All drives are there; fills up the lanes to a number of windows that all tiles have.
  void close(int windows);

  /// Works out values, advantages and returns.
  DriveTileSums judge(const Eigen::VectorXf& critic_parameters);

  /// To before the first window, with zero hidden state.
  void rewind();

  /// Gradients of the errors, summed over a window; both return over how many steps. The windows in their order.
  double policyGradient(int window, const Eigen::VectorXf& parameters, const DriveBatchWeights& weights);
  double criticGradient(int window, const Eigen::VectorXf& parameters);
  const Eigen::VectorXf& gradient() const { return gradient_; }

  double entropy() const { return entropy_; }  ///< nat, summed over stepsSeen()
  double stepsSeen() const { return steps_seen_; }

 private:
  DriveSlot& slotOf(int time, int lane);
  const float* inputsOf(const DriveSlot& slot) const;
  void fillInputs(const DriveSlot& slot, int count, float* input, int stride) const;
  void fillPolicyInputs(const DriveSlot& slot, int time, int lane);
  int preferenceAt(const DriveSlot& slot, int lane, int action) const;
  const float* criticValues(int window, const Eigen::VectorXf& parameters);
  void judgeLane(int lane, DriveTileSums* sums);
  void fillPolicyGradient(const DriveSlot& slot, int time, int lane, const DriveBatchWeights& weights);

  const DriveActorCriticParameters& parameters_;
  int actions_;
  int policy_inputs_;
  int views_;
  int drive_lanes_;
  Encoder encoder_;
  std::vector<int> action_views_;  ///< with eight views
  LaneNetwork policy_;
  LaneNetwork critic_;
  int windows_ = 0;
  std::vector<std::vector<DriveSlot>> lanes_;
  Eigen::VectorXf gradient_;
  double entropy_ = 0.0;
  double steps_seen_ = 0.0;
};

}  // namespace lstm_planner
