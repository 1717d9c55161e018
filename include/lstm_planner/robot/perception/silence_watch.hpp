#pragma once

#include "lstm_planner/robot/perception/laser_scan.hpp"
#include "lstm_planner/robot/perception/scan_rules.hpp"

namespace lstm_planner {

/// Notices a lens that is covered, for drivers that send NaN, zero or too short readings both for "nothing within
/// range" and for what a cover answers (ScanRules): one scan sees much, and the very next has such readings only. The
/// scanner then counts as covered until it sees something again. To drive or turn into an open field looks different,
/// since returns go a few at a time. A scanner that was covered before the first scan is not noticed.
class SilenceWatch {
 public:
  /// The scanner's next scan; `time` is its stamp, s. Scans more than 0.25 s apart are not compared with one another.
  void show(const LaserScan& scan, const ScanRules& rules, double time);

  bool isCovered() const { return is_covered_; }
  /// Of the beams of the scan before the cover, how many had a return.
  double shareBefore() const { return share_; }

 private:
  double share_ = 0.0;  ///< of the beams with a return, in the last scan that had one
  double time_ = 0.0;   ///< s, of the last scan
  bool is_covered_ = false;
};

}  // namespace lstm_planner
