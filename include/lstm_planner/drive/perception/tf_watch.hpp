#pragma once

#include <cmath>
#include <optional>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// Notices that tf has another pose of the robot than the odometry's topic, as where an EKF publishes the one and the
/// wheels the other. Costmaps are built with tf and read at the topic's pose: walls are then there twice.
class TfWatch {
 public:
  /// Both poses are of the same `stamp` (s) in the same frame; `speed` then, m/s. True while they have differed for a
  /// second: around a jump they do so for a moment.
  bool note(double stamp, const Pose2& by_topic, const Pose2& by_tf, double speed) {
    constexpr double kFarthest = 0.1;  // m, two cells of a usual costmap: one beside a return does no harm
    constexpr double kLate = 0.1;      // s by which one may be stamped later than the other
    constexpr double kLasts = 1.0;     // s
    const bool is_same = distanceBetween(by_topic, by_tf) < kFarthest + kLate * std::abs(speed);
    if (is_same || (since_ && stamp < *since_)) since_.reset();
    if (!is_same && !since_) since_ = stamp;
    return since_ && stamp - *since_ >= kLasts;
  }

 private:
  std::optional<double> since_;  ///< s, they have differed
};

}  // namespace lstm_planner
