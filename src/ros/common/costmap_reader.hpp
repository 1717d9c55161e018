#pragma once

#include <costmap_2d/costmap_2d_ros.h>

#include <mutex>
#include <string>
#include <vector>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// Locks a costmap, which may be null. Whoever holds the mutex of a plugin and wants this one, too, must have taken
/// this one first, as move_base does.
std::unique_lock<costmap_2d::Costmap2D::mutex_t> lockOf(costmap_2d::Costmap2DROS* costmap);

/// Reads the obstacles that one of move_base's costmaps has and a scan does not show (costmapObstacles()). Keeps
/// nothing: what is cleared in the costmap is gone.
class CostmapReader {
 public:
  /// `costmap`: null where it is not to be used. `reach`: farthest obstacle that is looked at, m.
  CostmapReader(costmap_2d::Costmap2DROS* costmap, double reach) : costmap_(costmap), reach_(reach) {}

  bool isUsed() const { return costmap_ != nullptr; }
  std::string frame() const;

  /// As points of the base frame, until the next call. `base`: where it is in frame(), `returns` of the scan
  /// in the base frame.
  const std::vector<Point2>& read(const Pose2& base, const std::vector<Point2>& returns);

 private:
  void sayWhatIsNear() const;

  costmap_2d::Costmap2DROS* costmap_;
  double reach_;
  std::vector<Point2> obstacles_;
};

}  // namespace lstm_planner
