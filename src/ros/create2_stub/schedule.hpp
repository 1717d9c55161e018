#pragma once

#include <cstdint>

namespace lstm_planner {

/// Something that is due every so often on the simulation's clock.
class Schedule {
 public:
  explicit Schedule(double hertz) : period_(static_cast<std::uint64_t>(1e9 / hertz + 0.5)) {}
  void restart(std::uint64_t now) { next_ = now; }
  /// True once a period, however often it is asked.
  bool due(std::uint64_t now) {
    if (now < next_) return false;
    next_ += ((now - next_) / period_ + 1) * period_;  // at once, however far the clock was set on
    return true;
  }

 private:
  std::uint64_t period_;    // ns
  std::uint64_t next_ = 0;  // ns
};

}  // namespace lstm_planner
