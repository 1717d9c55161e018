#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "lstm_planner/dataset/drive_step.hpp"
#include "lstm_planner/drive/decision/goal_tracker.hpp"
#include "lstm_planner/drive/perception/laser_scan.hpp"
#include "lstm_planner/drive/perception/odometry_history.hpp"

namespace lstm_planner {

// What a recorder hears of a drive, live or from a recording. Stamps in s.

using OdometryHeard = OdometryHistory::Entry;

/// A scan, and where its scanner is.
struct ScanHeard {
  double stamp = 0.0;
  LaserScan scan;
  SensorMount mount;
  std::string frame;
};

/// A goal to drive to.
struct GoalHeard {
  double stamp = 0.0;
  GoalInFrame goal;
  std::string source;  ///< Episode::goal_source
};

/// The goal is not driven to any more.
struct GoalGivenUp {
  double stamp = 0.0;
};

using DriveEvent = std::variant<OdometryHeard, GoalGivenUp, GoalHeard, ScanHeard>;

inline double stampOf(const DriveEvent& event) {
  return std::visit([](const auto& heard) { return heard.stamp; }, event);
}

/// Why an event cannot be used: a number that is not finite or larger than any measurement, a scan with too many beams,
/// a frame whose name is too long. Empty if nothing is wrong.
std::string flawOf(const DriveEvent& event);

/// Puts events into the order of their stamps: topics arrive independently of each other, so the order of arrival is
/// random. An event is given out when another one is `delay` (s) newer. What arrives within that time is always given
/// out in the same order; with equal stamps odometry, then goals, then scans. At most kMostWaiting events are held
/// back: if stamps stand still, the oldest is given out early.
class EventOrder {
 public:
  static constexpr std::size_t kMostWaiting = 4096;  ///< a second of odometry at 1 kHz with three fast scanners

  /// What became of an event.
  enum class Verdict {
    kTaken,    ///< it will be given out
    kLate,     ///< older than an event that was given out; not taken
    kClockSet  ///< the clock was set: the stamp differs by more than `horizon` from the newest one; see clear()
  };

  /// `delay`: s, see above. `horizon`: s by which a stamp may differ from the newest one.
  EventOrder(double delay, double horizon) : delay_(delay), horizon_(horizon) {}

  Verdict add(DriveEvent event);

  /// The oldest event if its time has come or too many wait; `all`: in any case. Empty if there is none.
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
