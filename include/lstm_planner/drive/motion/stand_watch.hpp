#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <optional>

#include "lstm_planner/common/geometry.hpp"
#include "lstm_planner/drive/perception/reach.hpp"

namespace lstm_planner {

/// Notices that a robot does not get away from a place: it stands there, tries to move without success, or moves
/// forwards and backwards.
class StandWatch {
 public:
  /// The robot is here at that time (s), on its way to `goal` (same frame); it was commanded to move, or not. With a
  /// new goal the time starts again.
  void note(const Pose2& pose, double time, const Point2& goal, bool is_commanded) {
    if (distanceBetween(goal_, goal) > kGoalShift || time < now_) clear();
    goal_ = goal;
    now_ = time;
    if (isNew(pose)) {
      since_.reset();
      retries_ = 0;
    }
    if (!since_) {
      since_ = time;
      tried_.reset();
    }
    if (is_commanded && !tried_) tried_ = time;
  }
  /// It stands for a good reason, such as a person: the time starts again.
  void excuse(double time) {
    if (since_) since_ = time;
    tried_.reset();
  }
  /// It is to try another way: the time starts again.
  void retry() {
    excuse(now_);
    ++retries_;
  }
  void clear() {
    places_.clear();
    since_.reset();
    retries_ = 0;
  }

  double stood() const { return since_ ? now_ - *since_ : 0.0; }  ///< s at this place
  double tried() const { return tried_ ? now_ - *tried_ : 0.0; }  ///< s of these since it was first commanded to move
  int retries() const { return retries_; }                        ///< at this place

 private:
  static constexpr double kMoved = 0.1;  // m; more than odometry's noise, less than the slowest robot drives in seconds
  static constexpr double kTurned = 0.3;                  // rad
  static constexpr double kMostTurns = 10.0 * kFullTurn;  // rad at a place; who looks around often turns less
  static constexpr std::size_t kMostPlaces = 8;           // less than 1 m

  /// Where it was, and how far it had turned there, rad; not wrapped.
  struct Place {
    Point2 position;
    double rightmost;
    double leftmost;
  };
  /// Where it has just been it gets away from nothing: it may turn to and fro, or drive. Who looks around turns on.
  bool isNew(const Pose2& pose) {
    heading_ += normalizeAngle(pose.yaw - heading_);
    const auto known = std::find_if(places_.begin(), places_.end(), [&](const Place& place) {
      return distanceBetween(place.position, pose) <= kMoved;
    });
    if (known == places_.end()) {
      places_.push_back({{pose.x, pose.y}, heading_, heading_});
      if (places_.size() > kMostPlaces) places_.pop_front();
      return true;
    }
    const bool turns_on = (heading_ < known->rightmost - kTurned || heading_ > known->leftmost + kTurned) &&
                          known->leftmost - known->rightmost < kMostTurns;
    if (turns_on) {
      known->rightmost = std::min(known->rightmost, heading_);
      known->leftmost = std::max(known->leftmost, heading_);
    }
    return turns_on;
  }

  std::deque<Place> places_;  ///< where it was last, oldest first
  double heading_ = 0.0;      ///< rad, not wrapped
  Point2 goal_;
  double now_ = 0.0;             ///< s
  std::optional<double> since_;  ///< s
  std::optional<double> tried_;  ///< s
  int retries_ = 0;
};

}  // namespace lstm_planner
