#pragma once

#include <vector>

#include "lstm_planner/base/learning/lane_network.hpp"
#include "lstm_planner/robot/driving/drive_policy.hpp"
#include "robot/learning/drive_lanes.hpp"

namespace lstm_planner {

/// Where drives lie among the lanes of a policy's network: each in one lane, or with eight views in eight, one for each
/// direction of the odometry frame.
class DriveViews {
 public:
  /// Throws as viewsOf().
  explicit DriveViews(const PolicyDescription& policy);

  /// Lanes of drives in a tile: few where there are many views, so that a tile's numbers stay in the cache.
  int driveLanes() const { return views_ == 1 ? 32 : 8; }
  int networkLanes() const { return driveLanes() * views_; }

  /// Before `step` of the network, for the drive in a lane of drives.
  void forget(int step, int lane, LaneNetwork* network) const;

  /// Fills the network's rows with what the views see at a place of a drive; zeros where there is no drive.
  void fillInputs(const DrivePlace& place, int lane, float* rows) const;

  /// Where an action's preference lies among the network's outputs. The place must have a drive.
  int outputAt(const DrivePlace& place, int lane, int action) const;

 private:
  int views_;
  Encoder encoder_;
  std::vector<int> action_views_;  ///< with eight views
};

}  // namespace lstm_planner
