#pragma once

#include <cstddef>
#include <deque>

namespace lstm_planner {

/// Measures how long a base takes to do what it is told, if that is longer than the controller expects: behind a
/// velocity smoother, a mux or a slow link. A robot whose heading changes later than its controller expects turns to
/// and fro, and stops later.
///
/// The delay is the shift at which commanded and measured turning speed of the last seconds agree best (largest
/// correlation). If they do not agree at any shift, the robot is held, or somebody else drives it. If they agree at
/// every shift, it is in a long even turn. Both say nothing about the base.
class ReactionWatch {
 public:
  /// The turning speed (rad/s) that was measured last, and that is now commanded for `period` s. `expected`: s, from
  /// command to motion, that the controller is prepared for.
  void note(double measured, double commanded, double period, double expected);

  /// s, if it is clearly longer than expected, else 0. What was found stays: where the base limits its acceleration, a
  /// wide turn comes later than a small one.
  double delay() const { return delay_; }

  /// The odometry jumped. What was found stays.
  void forget() { samples_.clear(); }

 private:
  struct Sample {
    double measured;
    double commanded;
  };

  double correlation(std::size_t lag) const;
  void judge(double expected);

  std::deque<Sample> samples_;  ///< newest last, a period apart
  double period_ = 0.0;         ///< s
  std::size_t unjudged_ = 0;    ///< samples since the last judgement
  double found_ = 0.0;          ///< s, by the last judgement
  double delay_ = 0.0;          ///< s
};

}  // namespace lstm_planner
