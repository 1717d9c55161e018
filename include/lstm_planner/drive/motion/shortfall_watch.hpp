#pragma once

#include <algorithm>

namespace lstm_planner {

/// Measures by how much a base is slower than it is told: weak motors, a slope, a node between that scales commands, or
/// motors that do not start at small commands. A controller that speeds up from what it measures would crawl there: it
/// commands a little more than what it measures, and gets that little less.
///
/// Each half second it compares what was told with what was measured. A base that gets faster is not too slow, but
/// speeds up; and one that has just braked may seem so once.
class ShortfallWatch {
 public:
  /// The speed that was measured last, and that is now commanded for `period` s; m/s, ahead. `step`: by how much the
  /// command may exceed what is measured, m/s.
  void note(double measured, double commanded, double period, double step) {
    measured_ += std::max(0.0, measured) * period;
    told_ += std::max(0.0, commanded) * period;
    time_ += period;
    if (time_ < kHalfSecond) return;
    const double speed = measured_ / time_;
    const bool gets_faster = speed > last_speed_ + kFaster;
    const bool is_short = told_ / time_ > speed + kShare * step;
    times_ = is_short && !gets_faster ? times_ + 1 : 0;
    if (times_ >= kTimes) {
      short_by_ = std::min(short_by_ + step, std::max(kMost, kMostShare * speed));
    } else if (!is_short) {
      short_by_ *= kForgets;
    }
    last_speed_ = speed;
    measured_ = told_ = time_ = 0.0;
  }

  /// m/s that the base is to be told more than it has reached; 0 where it does what it is told.
  double shortBy() const { return short_by_; }

 private:
  static constexpr double kHalfSecond = 0.5;  // s
  static constexpr int kTimes = 3;            // in a row
  static constexpr double kFaster = 0.02;     // m/s
  static constexpr double kShare = 0.5;       // of the step, by which the base is too slow
  static constexpr double kMost = 0.15;       // m/s, of a base that stands or creeps
  static constexpr double kMostShare = 0.5;   // of the measured speed
  static constexpr double kForgets = 0.5;

  double measured_ = 0.0;    ///< m, in this half second
  double told_ = 0.0;        ///< m
  double time_ = 0.0;        ///< s
  double last_speed_ = 0.0;  ///< m/s, in the half second before
  int times_ = 0;            ///< in a row that it was too slow
  double short_by_ = 0.0;    ///< m/s
};

}  // namespace lstm_planner
