#pragma once

#include <vector>

#include "lstm_planner/common/footprint.hpp"
#include "lstm_planner/drive/perception/situation.hpp"

namespace lstm_planner {

/// Remembers returns near the robot that its scanner does not see any more, because they left its field of view or are
/// hidden: the corners of a robot that turns, or a robot that drives back, could hit them.
///
/// As exact as odometry over a few metres. Inside the field of view nothing is remembered: there the scan counts. A
/// place is forgotten when the robot has moved away from it.
class OutOfView {
 public:
  /// Of a robot of that footprint.
  explicit OutOfView(const Footprint& footprint) : near_(footprint.circumscribedRadius() + kAround) {}

  /// What is seen now.
  void show(const Situation& situation);

  /// As of the last situation shown, in its base frame, m.
  const std::vector<Point2>& points() const { return points_; }

  /// The odometry jumped: nothing is where it was.
  void forget();

 private:
  static constexpr double kAround = 1.5;  // m: a robot with corners goes back as far as this (Trail)

  double near_;                    ///< m from the robot's middle within which returns matter
  Pose2 pose_;                     ///< odometry frame, of the last situation
  std::vector<Point2> points_;     ///< base frame, oldest first
  std::vector<Point2> seen_last_;  ///< returns of the last situation within near_, base frame
};

}  // namespace lstm_planner
