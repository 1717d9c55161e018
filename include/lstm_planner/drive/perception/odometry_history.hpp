#pragma once

#include <deque>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/twist_watch.hpp"

namespace lstm_planner {

/// The odometry of the last second: gives the pose at the moment a scan was taken, notices jumps, and says how fast the
/// robot is.
class OdometryHistory {
 public:
  /// One measurement.
  struct Entry {
    double stamp = 0.0;  ///< s
    Pose2 pose;          ///< base in the odometry frame
    Twist2 twist;        ///< as the message says it, base frame
  };

  /// `max_speed`: m/s; what moves faster has jumped.
  explicit OdometryHistory(double max_speed) : max_speed_(max_speed) {}

  /// Adds an entry, which must be finite. After a jump of the pose or of the clock the history is empty. One that is
  /// stamped at most 0.5 s before the newest is left out.
  void add(const Entry& entry);

  /// What comes next is of another frame: counts as a jump, unless there was nothing before.
  void restart();

  bool empty() const { return entries_.empty(); }
  const Entry& newest() const { return entries_.back(); }

  /// The pose at `stamp`: interpolated, or, up to 0.2 s beyond the newest entry, continued at the speed of at least the
  /// last 0.05 s. The nearest known pose for anything farther away. Requires !empty().
  Pose2 poseAt(double stamp) const;

  /// The robot's speed, which is not always what the newest entry says.
  Twist2 twist() const { return twist_.twist(); }
  const TwistWatch& twistWatch() const { return twist_; }

  /// Number of jumps so far.
  long jumps() const { return jumps_; }

 private:
  bool isOvertaken(const Entry& entry) const;
  bool follows(const Entry& entry) const;

  double max_speed_;
  std::deque<Entry> entries_;
  TwistWatch twist_;
  long jumps_ = 0;
};

}  // namespace lstm_planner
