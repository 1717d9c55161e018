#pragma once

#include <vector>

#include "lstm_planner/drive/decision/drive_policy.hpp"
#include "lstm_planner/training/lane_network.hpp"
#include "practice/drive_queues.hpp"

namespace lstm_planner {

/// Where queues of drives lie among the lanes of a policy's network: each in one lane, or with eight views in eight,
/// one for each direction of the odometry frame.
class DriveViews {
 public:
  /// Throws as viewsOf().
  explicit DriveViews(const PolicyDescription& policy)
      : views_(policy.encoder.views),
        encoder_(policy.encoder),
        action_views_(views_ == 1 ? std::vector<int>() : viewsOf(policy.actions)) {}

  /// Queues of drives in a tile: few where there are many views, so that a tile's numbers stay in the cache.
  int queues() const { return views_ == 1 ? 32 : 8; }
  int networkLanes() const { return queues() * views_; }

  /// Before `step` of the network, for the drive of a queue.
  void forget(int step, int queue, LaneNetwork* network) const {
    for (int view = 0; view < views_; ++view) network->forget(step, queue * views_ + view);
  }

  /// Fills the network's rows with what the views see at a step of a drive; zeros where there is no drive.
  void fillInputs(const DriveSlot& slot, int queue, float* rows) const {
    const int stride = networkLanes();
    float* first = rows + queue * views_;
    const float* ahead = inputsOf(slot, encoder_.size());
    if (views_ == 1 || !ahead) {
      for (int row = 0; row < encoder_.size(); ++row) {
        for (int view = 0; view < views_; ++view) first[row * stride + view] = ahead ? ahead[row] : 0.0f;
      }
      return;
    }
    encoder_.turn(ahead, slot.episode->bearings[slot.step], first, stride);
  }

  /// Where an action's preference lies among the network's outputs. The slot must have a drive.
  int outputAt(const DriveSlot& slot, int queue, int action) const {
    if (views_ == 1) return action * networkLanes() + queue;
    const int ahead = slot.episode->bearings[slot.step].ahead;
    return queue * views_ + (ahead + action_views_[static_cast<std::size_t>(action)]) % views_;
  }

 private:
  int views_;
  Encoder encoder_;
  std::vector<int> action_views_;  ///< with eight views
};

}  // namespace lstm_planner
