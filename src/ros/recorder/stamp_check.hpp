#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace lstm_planner {

/// Tells stamps that are far ahead of all others, such as 2^32 - 1 s, from a clock that was set: they would make tf
/// forget everything else.
class StampCheck {
 public:
  /// False for a stamp (s) that is more than an hour ahead of when its message was received and of the stamps before,
  /// unless the previous stamp was ahead by about as much.
  bool isPlausible(double stamp, double received) {
    constexpr double kHour = 3600.0;  // s
    const bool is_near = stamp <= std::max(received, newest_.value_or(received)) + kHour;
    const bool is_other_clock = refused_ && std::abs(stamp - *refused_) <= kHour;
    (is_near || is_other_clock ? newest_ : refused_) = stamp;
    return is_near || is_other_clock;
  }

 private:
  std::optional<double> newest_;   ///< s
  std::optional<double> refused_;  ///< s, the last one
};

}  // namespace lstm_planner
