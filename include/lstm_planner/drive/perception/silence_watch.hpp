#pragma once

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"
#include "lstm_planner/drive/perception/period_meter.hpp"
#include "lstm_planner/drive/perception/scan_rules.hpp"

namespace lstm_planner {

/// Notices a lens that is covered or a scanner that fails, since drivers send the same reading for it as for "nothing
/// within range", be it +inf or another one (ScanRules): one scan sees much, and the next nothing. The scanner then
/// counts as covered until it sees something again. To drive or turn into an open field looks different,
/// since returns go a few at a time. A scanner that was covered before the first scan is not noticed.
class SilenceWatch {
 public:
  /// The scanner's next scan; `time` is its stamp, s; `pose`: the robot's, newest, by odometry. Two scans are compared
  /// if they follow one another (at the scanner's measured period, or within 0.25 s), and after a pause, however long,
  /// if the robot has moved by less than 0.5 m and turned by less than 0.6 rad: what it saw must then still be there.
  void show(const LaserScan& scan, const ScanRules& rules, double time, const Pose2& pose);

  /// The odometry has jumped to `pose`, at `time` (its stamp, s). Unless that is near the last scan's, by the limits
  /// above, the robot was put elsewhere, as by a simulator, and may see nothing there: what it saw is forgotten, as at
  /// the start.
  void noteJump(double time, const Pose2& pose);

  bool isCovered() const { return is_covered_; }
  /// Of the beams of the scan before the cover, how many had a return.
  double shareBefore() const { return share_; }

 private:
  bool isComparable(double time, const Pose2& pose) const;
  bool isNear(const Pose2& pose) const;

  double share_ = 0.0;  ///< of the beams with a return, in the last scan that had one; 0 where these were few
  double time_ = 0.0;   ///< s, of the last scan
  Pose2 pose_;          ///< at the last scan
  double jump_ = 0.0;   ///< s, of the last jump of the odometry
  PeriodMeter period_;
  bool is_covered_ = false;
};

}  // namespace lstm_planner
