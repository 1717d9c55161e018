#pragma once

#include <array>
#include <cstddef>

namespace lstm_planner {

/// Measures the period of a sensor's messages from their stamps. Lost messages do not matter, as long as a quarter of
/// the intervals are complete; pauses of more than a second are ignored.
class PeriodMeter {
 public:
  /// The stamp of the next message, s.
  void note(double stamp);

  /// s, a quartile of the last intervals; 0 as long as there are too few of them.
  double period() const { return period_; }

 private:
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
double timeoutFor(double set, double period, double least);

}  // namespace lstm_planner
