#pragma once

#include <deque>
#include <optional>

#include "lstm_planner/common/geometry.hpp"

namespace lstm_planner {

/// Notices that a robot does not get away from a place: it stands there, tries to move without success, or moves
/// forwards and backwards.
class StandWatch {
 public:
  /// The robot is here at that time (s), on its way to `goal` (same frame); it was commanded to move, or not. With a
  /// new goal the time starts again.
  void note(const Pose2& pose, double time, const Point2& goal, bool is_commanded);
  /// It stands for a good reason, such as a person: the time starts again.
  void excuse(double time);
  /// It is to try another way: the time starts again.
  void retry();
  void clear();

  double stood() const { return since_ ? now_ - *since_ : 0.0; }  ///< s at this place
  double tried() const { return tried_ ? now_ - *tried_ : 0.0; }  ///< s of these since it was first commanded to move
  int retries() const { return retries_; }                        ///< at this place

 private:
  /// Where it was, and how far it had turned there, rad; not wrapped.
  struct Place {
    Point2 position;
    double rightmost;
    double leftmost;
  };
  bool isNew(const Pose2& pose);

  std::deque<Place> places_;  ///< where it was last, oldest first
  double heading_ = 0.0;      ///< rad, not wrapped
  Point2 goal_;
  double now_ = 0.0;             ///< s
  std::optional<double> since_;  ///< s
  std::optional<double> tried_;  ///< s
  int retries_ = 0;
};

}  // namespace lstm_planner
