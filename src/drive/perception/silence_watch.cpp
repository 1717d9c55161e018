#include "lstm_planner/drive/perception/silence_watch.hpp"

#include <algorithm>
#include <cmath>

#include "drive/perception/beam_sum.hpp"

namespace lstm_planner {

namespace {

constexpr int kFewestReturns = 8;      // of few beams, somebody who passes by has more than kMuch
constexpr double kMuch = 0.2;          // of the beams; more than a turn of 2 rad/s takes out of sight between two scans
constexpr double kMostApart = 0.25;    // s
constexpr double kMostPeriods = 2.5;   // a scanner may lose a scan
constexpr double kHardlyMoved = 0.5;   // m; a robot of 1 m/s stands before, for want of scans
constexpr double kHardlyTurned = 0.6;  // rad; less than kMuch of a fan of 180 degrees
constexpr double kMostlySilent = 0.5;  // of the beams

}  // namespace

bool SilenceWatch::isComparable(double time, const Pose2& pose) const {
  const double apart = time - time_;
  if (apart >= 0.0 && apart <= std::max(kMostApart, kMostPeriods * period_.period())) return true;
  return isNear(pose);
}

bool SilenceWatch::isNear(const Pose2& pose) const {
  return distanceBetween(pose, pose_) <= kHardlyMoved && turnBetween(pose, pose_) <= kHardlyTurned;
}

void SilenceWatch::noteJump(double time, const Pose2& pose) {
  jump_ = time;
  if (isNear(pose)) return;
  share_ = 0.0;
  is_covered_ = false;
}

void SilenceWatch::show(const LaserScan& scan, const ScanRules& rules, double time, const Pose2& pose) {
  if (scan.ranges.empty() || !(scan.range_min < scan.range_max)) return;  // nothing can be said of it
  RangeProfile profile;
  toProfile(scan, {}, rules, &profile);
  const BeamSum returns = sumOfBeams(profile.ranges.data(), profile.ranges.size(), 1.0);
  const auto beams = static_cast<double>(scan.ranges.size());
  if (returns.measured > 0) {
    // A scan of before the jump may come after it, and says nothing of what the next one must see.
    const bool tells = returns.measured >= kFewestReturns && time >= jump_;
    share_ = tells ? returns.measured / beams : 0.0;
    is_covered_ = false;
  } else if (!is_covered_) {
    is_covered_ = share_ >= kMuch && returns.known >= kMostlySilent * beams && isComparable(time, pose);
    if (!is_covered_) share_ = 0.0;
  }
  time_ = time;
  pose_ = pose;
  period_.note(time);
}

}  // namespace lstm_planner
