#pragma once

#include <deque>
#include <optional>

#include "lstm_planner/dataset/drive_events.hpp"

namespace lstm_planner {

/// Puts events into the order of their stamps: topics arrive independently of each other, so what comes first is
/// chance. An event is given out when another one is `delay` (s) newer. Whatever arrives within that time comes out in
/// the same order every time; of equal stamps odometry, then goals, then scans.
class EventOrder {
 public:
  enum class Verdict {
    kTaken,
    kLate,     ///< older than what was given out; not taken
    kClockSet  ///< the clock was set: the event is older than `horizon`, or newer than all by more; see clear()
  };

  /// `horizon`: s by which an event may be away from the newest.
  EventOrder(double delay, double horizon) : delay_(delay), horizon_(horizon) {}

  Verdict add(DriveEvent event);

  /// The oldest event if its time has come; `all`: whether or not.
  std::optional<DriveEvent> take(bool all = false);

  /// Forgets which stamps there were.
  void clear();

 private:
  double delay_;
  double horizon_;
  std::deque<DriveEvent> events_;  ///< in order
  std::optional<double> newest_;   ///< s
  std::optional<double> taken_;    ///< s
};

}  // namespace lstm_planner
