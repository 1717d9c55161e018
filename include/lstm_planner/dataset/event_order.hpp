#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "lstm_planner/dataset/drive_events.hpp"

namespace lstm_planner {

/// Puts events into the order of their stamps: topics arrive independently of each other, so what comes first is
/// chance. An event is given out when another one is `delay` (s) newer. Whatever arrives within that time comes out in
/// the same order every time; of equal stamps odometry, then goals, then scans. At most kMostWaiting events are held
/// back: where stamps stand still, the oldest is given out early.
class EventOrder {
 public:
  static constexpr std::size_t kMostWaiting = 4096;  ///< a second of odometry at 1 kHz with three fast scanners

  /// What became of an event.
  enum class Verdict {
    kTaken,    ///< it is given out in its turn
    kLate,     ///< older than what was given out; not taken
    kClockSet  ///< the clock was set: the event is older than `horizon`, or newer than all by more; see clear()
  };

  /// `horizon`: s by which an event may be away from the newest.
  EventOrder(double delay, double horizon) : delay_(delay), horizon_(horizon) {}

  Verdict add(DriveEvent event);

  /// The oldest event if its time has come, or too many wait; `all`: whether or not.
  std::optional<DriveEvent> take(bool all = false);

  /// Forgets which stamps there were.
  void clear();

 private:
  double delay_;
  double horizon_;
  /// By stamp (s) and kind: the variant lists kinds in the order in which events of the same moment are worked on.
  std::multimap<std::pair<double, std::size_t>, DriveEvent> events_;
  std::optional<double> newest_;  ///< s
  std::optional<double> taken_;   ///< s
};

}  // namespace lstm_planner
