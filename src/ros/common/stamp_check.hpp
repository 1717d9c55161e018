#pragma once

#include <optional>

namespace lstm_planner {

/// Tells stamps that are far ahead of all others, such as 2^32 - 1 s, from a clock that was set: they would make tf
/// forget everything else.
class StampCheck {
 public:
  /// False for a stamp (s) that is more than an hour ahead of when its message was received and of the stamps before,
  /// unless the previous stamp was ahead by about as much.
  bool isPlausible(double stamp, double received);

 private:
  std::optional<double> newest_;   ///< s
  std::optional<double> refused_;  ///< s, the last one
};

}  // namespace lstm_planner
