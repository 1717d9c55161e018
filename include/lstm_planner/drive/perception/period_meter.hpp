#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace lstm_planner {

/// Measures the period of a sensor's messages from their stamps. Lost messages do not matter, as long as a quarter of
/// the intervals are complete; pauses of more than a second are ignored.
class PeriodMeter {
 public:
  /// The stamp of the next message, s.
  void note(double stamp) {
    const double interval = stamp - stamp_;
    const bool counts = has_stamp_ && interval > 0.0 && interval <= kPause;
    stamp_ = stamp;
    has_stamp_ = true;
    if (!counts) return;
    intervals_[count_++ % kMost] = interval;
    const std::size_t known = std::min(count_, kMost);
    if (known < kFewest) return;
    std::array<double, kMost> sorted = intervals_;
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(known);
    const auto quartile = sorted.begin() + static_cast<std::ptrdiff_t>(known / 4);
    std::nth_element(sorted.begin(), quartile, end);
    period_ = *quartile;
  }

  /// s, a quartile of the last intervals; 0 as long as there are too few of them.
  double period() const { return period_; }

 private:
  static constexpr double kPause = 1.0;  // s
  static constexpr std::size_t kFewest = 4;
  static constexpr std::size_t kMost = 16;

  double stamp_ = 0.0;
  bool has_stamp_ = false;
  std::array<double, kMost> intervals_{};  ///< s, the newest ones
  std::size_t count_ = 0;                  ///< of all so far
  double period_ = 0.0;
};

/// Largest age of a message, s: `set` if that is more than 0. Otherwise three of the sensor's periods (s, 0: not known
/// yet), at least `least` and at most one second: for a slower sensor the limit must be set.
inline double timeoutFor(double set, double period, double least) {
  constexpr double kPeriods = 3.0;          // that a message may be late
  constexpr double kLongestMeasured = 1.0;  // s
  return set > 0.0 ? set : std::clamp(kPeriods * period, least, std::max(least, kLongestMeasured));
}

}  // namespace lstm_planner
