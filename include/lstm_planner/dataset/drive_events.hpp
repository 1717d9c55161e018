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

// What a recorder hears of a drive, whether it happens now or was recorded by something else. Stamps in s.

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

/// Why nobody can work on an event, whoever heard it: a number that is not finite or larger than any measurement, a
/// scan of too many beams, a frame with too long a name. Empty when nothing is wrong.
std::string flawOf(const DriveEvent& event);

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
