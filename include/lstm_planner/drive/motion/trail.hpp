#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// The last 1.5 m of the path that a robot came, as poses in the odometry frame: where it was nothing stands, and how
/// it came it can go back, also where it does not see. Loops are cut: what it did between two visits of a place is no
/// way back.
class Trail {
 public:
  /// The robot is here now. `goes_back`: it retraces the trail, which becomes shorter instead of longer.
  void note(const Pose2& pose, bool goes_back);

  /// The next pose back, in the robot's frame; none at the trail's end, nor where the robot is farther than 2 cm or
  /// 0.05 rad from each pose of the trail, 2.5 times that if it goes back already. A robot that stops there, and is
  /// noted, may go on back from there. The pose lies ahead where the robot had driven backwards.
  std::optional<Pose2> back(const Pose2& pose, bool goes_back = false) const;

  /// Its poses as seen from one of them or from elsewhere, oldest first.
  std::vector<Pose2> seenFrom(const Pose2& pose) const;

  /// Whether a robot there has gone back all of it, to within five spacings, as back() leads it.
  bool endsAt(const Pose2& pose) const;

  bool isEmpty() const { return places_.empty(); }

  /// The odometry jumped.
  void clear() { places_.clear(); }

 private:
  /// One of its poses.
  struct Place {
    Pose2 pose;
    double along;  ///< in spacings, from wherever the trail began
  };
  void cutLoop(const Pose2& pose);

  std::deque<Place> places_;  ///< oldest first
};

}  // namespace lstm_planner
